// Values of a law as typed by a user: words and numbers.
#pragma once

#include "laws/law_table.hpp"

#include <string>
#include <utility>
#include <vector>

namespace kaya {

/// Index of the property that a word names and that takes the value. `noun` is the kind of law, "joint model". Throws Diagnostic for a word that
/// the law does not know and a value outside its limits.
std::size_t accepting_property(const LawTable& law, const char* noun, const std::string& word, double value);

/// The values of all properties in the order of the law's table: the given ones, else the initial ones. Throws Diagnostic as
/// accepting_property.
std::vector<double> values_of(const LawTable& law, const char* noun,
                              const std::vector<std::pair<std::string, double>>& given);

} // namespace kaya
