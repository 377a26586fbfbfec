// Uses of the names that are not local to a function: which variables it reads and sets, and which functions it calls.
#pragma once

#include "lang/fish/compiler.hpp"

#include <string>
#include <vector>

namespace kaya::fish {

enum class Use {
    read,    ///< name, in an expression
    call,    ///< name(...): a function, or an element of an array
    line,    ///< a line that is just the name, with or without arguments: a call, or it does nothing
    declare, ///< global name
    set,     ///< name = value, array name(n), a variable of a loop
    element, ///< name(i) = value
    command, ///< @name in a command block, which the command will look up
};

struct NameUse {
    std::string name;
    Use use = Use::read;
    int arguments = 0; ///< of a call, a line and an element
    Place place;
    Dialect dialect = Dialect::classic;
};

/// In the order of the lines. Locals, arguments and the value of a function under its own name are left out.
std::vector<NameUse> name_uses(const Function& function);
std::vector<NameUse> name_uses(const Expression& expression);

/// Whether a line of the function gives it a value: one that sets its name, or `return` with a value.
bool gives_value(const Function& function);

} // namespace kaya::fish
