// What two saved models do not have in common.
#pragma once

#include <string>

namespace kaya {

/// A line for each column, value or text that differs, with how many and by how much; empty when the models are the same. Scripts
/// and deck texts are compared too. Throws Diagnostic when one of them cannot be read.
std::string save_file_difference(const std::string& first, const std::string& second);

} // namespace kaya
