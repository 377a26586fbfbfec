// Numbers and words, usual and unusual.
#pragma once

#include "tests/chance.hpp"

#include <string>
#include <vector>

namespace kaya::soak {

using test::Chance;

/// Zero, huge, tiny, negative, or not a number.
std::string odd_number(Chance& c);
/// Of the magnitude of the models of the cases.
std::string plain_number(Chance& c);
/// A plain one, sometimes an odd one.
std::string number(Chance& c, double odd = 0.1);
std::string odd_word(Chance& c);

/// Words with blanks between them.
std::vector<std::string> split(const std::string& line);
std::string join(const std::vector<std::string>& words, const char* between = " ");

} // namespace kaya::soak
