// A deck in its long form: whole words in place of shortened ones, one blank between words.
#pragma once

#include "lang/interp/binder.hpp"

#include <string>

namespace kaya::lang {

/// The same deck with whole words. Numbers, names, texts, comments, continuation marks and the lines of
/// functions stay as they are, and so does what follows `return`. To format the result gives it again.
/// Throws DeckErrors when the deck does not bind. Called files are not looked at.
std::string format_deck(const Language& language, const Source& source);

} // namespace kaya::lang
