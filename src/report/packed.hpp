// Columns of numbers as text that a browser unpacks: first bytes of all numbers, then second bytes and so on, which deflate (RFC 1950)
// compresses better than the plain numbers; then base64.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

std::string packed_bytes(std::string_view bytes);

/// The k-th bytes of all numbers together, for each k.
std::string byte_planes(std::string_view bytes, std::size_t size);

template <class Number> std::string packed(std::span<const Number> numbers) {
    return packed_bytes(
        byte_planes({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()}, sizeof(Number)));
}

/// To 16 bits, about five digits: enough for a view. NaN and infinity are unchanged.
float rounded(float number);

/// Packed after rounding.
std::string packed_rounded(std::vector<float> numbers);

} // namespace kaya
