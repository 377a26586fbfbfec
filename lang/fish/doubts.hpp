// Code of a function that is valid, but is hardly what the author meant.
#pragma once

#include "lang/fish/compiler.hpp"

#include <vector>

namespace kaya::fish {

/// Warnings in the order of the lines: a case that occurs twice, a text compared with a number, a vector of two numbers, 1/2 of classic FISH.
std::vector<Diagnostic> doubts(const Function& function);

} // namespace kaya::fish
