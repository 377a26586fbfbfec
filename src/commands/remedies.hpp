// Advice of the engine in the words of a deck.
#pragma once

#include "mechanics/remedy.hpp"

namespace kaya {

/// The mistake with its hint; its message, too, where that takes a word of a deck.
Diagnostic worded(const Advised& mistake);

} // namespace kaya
