// A deck in the words of the other dialect.
#pragma once

#include "lang/interp/source.hpp"
#include "base/diagnostic.hpp"

#include <string>
#include <vector>

namespace kaya::lang {

enum class To { classic, modern };

struct ConvertedDeck {
    std::string text;
    std::vector<Diagnostic> kept; ///< a note for each command that the other dialect cannot say; it stays as it is
    int changed = 0;              ///< commands in new words
};

/// The deck with its commands in the words of the other dialect. Comments, empty lines, layout and functions are unchanged. A line is changed
/// only when its new words fill the same struct; the others stay, below a comment that says so. Files may mix dialects, so the deck runs as
/// before. Throws DeckErrors when it does not bind.
ConvertedDeck convert_deck(const Source& source, To to);

} // namespace kaya::lang
