// Random chunks of Lua: its library with odd arguments, fields of live and deleted objects, commands and hooks.
#pragma once

#include "deck_lines.hpp"
#include "vocabulary.hpp"

#include <string>

namespace kaya::soak {

class LuaSoup {
public:
    LuaSoup(const Vocabulary& vocabulary, const DeckLines& lines) : vocabulary_(vocabulary), lines_(lines) {}

    /// lua ... endlua; a failing statement does not stop the next ones.
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
