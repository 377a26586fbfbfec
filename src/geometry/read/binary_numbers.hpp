// Numbers of binary files, in either order of bytes. Private to geometry.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace kaya {

enum class NumberKind { signed_whole, unsigned_whole, real };

struct NumberType {
    NumberKind kind;
    std::size_t bytes; ///< 1, 2, 4 or 8
};

static_assert(std::endian::native == std::endian::little, "numbers are composed from their lowest byte on");

/// The number that begins at `bytes`; whole numbers above 2^53 are rounded.
inline double number_at(const char* bytes, NumberType type, bool big_endian) {
    std::array<char, 8> raw{};
    for (std::size_t i = 0; i < type.bytes; ++i) raw[big_endian ? type.bytes - 1 - i : i] = bytes[i];
    if (type.kind == NumberKind::real)
        return type.bytes == 8 ? std::bit_cast<double>(raw)
                               : static_cast<double>(std::bit_cast<std::array<float, 2>>(raw)[0]);
    const auto whole = std::bit_cast<std::uint64_t>(raw);
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
    if (type.kind == NumberKind::signed_whole && (whole & sign) != 0) // its bits above the sign are zero
        return -static_cast<double>((sign - 1 - (whole & (sign - 1))) + 1);
    return static_cast<double>(whole);
}

} // namespace kaya
