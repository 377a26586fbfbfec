// A deck in its long form: whole words in place of shortened ones, one blank between words.
#pragma once

#include "lang/interp/binder.hpp"

#include <string>

namespace kaya::lang {

/// The same deck with whole words. Numbers, names, texts, comments, continuation marks, the lines of functions and the text after `return`
/// are unchanged. Formatting is idempotent. Throws DeckErrors when the deck does not bind. Called files are not read.
std::string format_deck(const Language& language, const Source& source);

} // namespace kaya::lang
