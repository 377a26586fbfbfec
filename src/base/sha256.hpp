// Cryptographic digest that identifies a file which others might replace.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// SHA-256 (FIPS 180-4) in 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

} // namespace kaya
