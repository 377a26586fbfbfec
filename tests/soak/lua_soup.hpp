// Chunks of Lua made by chance: its library with odd arguments, fields of objects that live and that are gone, commands and hooks.
#pragma once

#include "deck_lines.hpp"
#include "vocabulary.hpp"

#include <string>

namespace kaya::soak {

class LuaSoup {
public:
    LuaSoup(const Vocabulary& vocabulary, const DeckLines& lines) : vocabulary_(vocabulary), lines_(lines) {}

    /// lua ... endlua; a statement that fails does not keep the next ones from running.
    std::string chunk(Chance& c) const;

private:
    std::string expression(Chance& c, int depth) const;
    std::string object(Chance& c) const;
    std::string field(Chance& c) const;
    std::string library_call(Chance& c, int depth) const;
    std::string statement(Chance& c) const;

    const Vocabulary& vocabulary_;
    const DeckLines& lines_;
};

} // namespace kaya::soak
