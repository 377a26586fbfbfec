// Differences of two saved models.
#pragma once

#include <string>

namespace kaya {

/// A line for each column, value or text that differs, with the number and size of the differences; empty when the models are equal.
/// Scripts and deck texts are compared too. Throws Diagnostic when a file cannot be read.
std::string save_file_difference(const std::string& first, const std::string& second);

} // namespace kaya
