// Advice of the engine in the words of a deck.
#pragma once

#include "mechanics/common/remedy.hpp"

namespace kaya {

/// The error with its hint; the message too, where it contains a word of a deck. The words are those of the dialect of a line.
Diagnostic worded(const Advised& mistake, bool modern);

} // namespace kaya
