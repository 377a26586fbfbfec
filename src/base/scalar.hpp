// Types of the numbers that state is stored as.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace kaya {

enum class Scalar : std::uint8_t { boolean, uint8, int32, uint32, int64, uint64, float64 };

template <class T> constexpr Scalar scalar_of() {
    if constexpr (std::is_same_v<T, double>) return Scalar::float64;
    else if constexpr (std::is_same_v<T, bool>) return Scalar::boolean;
    else if constexpr (sizeof(T) == 1) return Scalar::uint8;
    else if constexpr (sizeof(T) == 4) return std::is_signed_v<T> ? Scalar::int32 : Scalar::uint32;
    else return std::is_signed_v<T> ? Scalar::int64 : Scalar::uint64;
}

/// Bytes of one.
constexpr std::size_t size_of(Scalar type) {
    switch (type) {
    case Scalar::boolean:
    case Scalar::uint8: return 1;
    case Scalar::int32:
    case Scalar::uint32: return 4;
    case Scalar::int64:
    case Scalar::uint64:
    case Scalar::float64: return 8;
    }
    return 0;
}

} // namespace kaya
