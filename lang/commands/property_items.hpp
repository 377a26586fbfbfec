// Words and values that belong to a joint or zone model, which are known at run time only.
#pragma once

#include "lang/commands/builder.hpp"

namespace kaya::lang {

/// Reads a word and its value; false, without taking a word, when the next word is more likely a misspelt `range`, `model` or `load`.
bool read_property_item(Reader& reader, std::vector<Property::Item>& items);

} // namespace kaya::lang
