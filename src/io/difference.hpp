// Differences of two saved models.
#pragma once

#include <string>

namespace kaya {

/// A line for each column, value or text that differs, with their number and size; empty when the models are the same. Scripts and deck
/// texts are compared too. Throws Diagnostic when one of them cannot be read.
std::string save_file_difference(const std::string& first, const std::string& second);

} // namespace kaya
