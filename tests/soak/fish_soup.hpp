// Random FISH functions: every name of the language, on objects of the right kind, of a wrong kind, and deleted ones.
#pragma once

#include "deck_lines.hpp"
#include "vocabulary.hpp"

#include <string>

namespace kaya::soak {

class FishSoup {
public:
    FishSoup(const Vocabulary& vocabulary, const DeckLines& lines) : vocabulary_(vocabulary), lines_(lines) {}

    /// def name ... end
    std::string function(const std::string& name, Chance& c) const;
    std::string expression(Chance& c, int depth) const;

private:
    std::string literal(Chance& c) const;
    std::string object(Chance& c, const Vocabulary::Kind* kind) const;
    std::string call(const Vocabulary::Name& name, Chance& c, int depth) const;
    std::string statement(Chance& c, int depth) const;
    std::string block(Chance& c, int depth) const;
    std::string commands(Chance& c) const;

    const Vocabulary& vocabulary_;
    const DeckLines& lines_;
};

} // namespace kaya::soak
