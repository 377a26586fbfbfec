// The commands inside of FISH functions, for checks before they run.
#pragma once

#include "lang/fish/compiler.hpp"

#include <vector>

namespace kaya::fish {

struct InnerCommand {
    int line = 0;        ///< of the deck, its first
    bool joined = false; ///< an expression is part of a word (`save [name].sav`): its words are known at run time only
};

/// Of all `command` blocks of the function, in the order of the lines.
std::vector<InnerCommand> inner_commands(const Function& function);

} // namespace kaya::fish
