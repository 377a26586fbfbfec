// Names of groups, with the slots that they are in.
#pragma once

#include "lang/modern/leaf.hpp"

namespace kaya::lang {

/// The word `slot` and a name after the name of a group.
KeywordSpec slot_word();
/// Reads `slot s` if it follows.
void read_slot(Reader& reader);

/// The range element `group s [slot s] [matches n]`.
void group_element(Keywords<RangePhrase>& table);

} // namespace kaya::lang
