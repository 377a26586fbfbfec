// Shared by the parts of the table of range elements.
#pragma once

#include "lang/commands/builder.hpp"

namespace kaya::lang {

/// A new element of the phrase with its parts; its place is that of the word before them.
Parts<RangePhrase> element(RangeElement::Kind kind, const Parts<RangeElement>& parts = {});

/// The element orientation, whose default of the tolerance belongs to the dialect.
Parts<RangePhrase> orientation_element(double default_tolerance);

/// Throws when the next word is not an element and is close to a word of the present element.
void misspelt_part(const Reader& reader, std::string_view element, const std::vector<KeywordSpec>& words);

/// An element that lacks a part: when a misspelt word stands there, the message is about that word.
[[noreturn]] void lacks_part(const Reader& reader, std::string_view element, const std::vector<KeywordSpec>& words,
                             std::string message, std::string hint);

void space_elements(Keywords<RangePhrase>& table);  ///< box, plane, sphere, cylinder
void figure_elements(Keywords<RangePhrase>& table); ///< orientation, polygon, rectangle, ellipse

} // namespace kaya::lang
