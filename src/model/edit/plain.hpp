// How the types of columns are laid out in memory. Hash and save work on scalars, never on the bytes
// of a struct that might have padding.
#pragma once

#include "model/tables/contacts.hpp"

#include <type_traits>

namespace kaya {

/// `count` values of type `scalar`, consecutive, and nothing else.
template <class T> struct Plain;

template <class T>
requires std::is_arithmetic_v<T>
struct Plain<T> {
    using scalar = T;
    static constexpr std::size_t count = 1;
};

template <class T>
requires std::is_enum_v<T>
struct Plain<T> {
    using scalar = std::underlying_type_t<T>;
    static constexpr std::size_t count = 1;
};

template <class S, int R, int C> struct Plain<Eigen::Matrix<S, R, C>> {
    using scalar = S;
    static constexpr std::size_t count = static_cast<std::size_t>(R) * C;
};

template <class S, std::size_t N> struct Plain<std::array<S, N>> {
    using scalar = S;
    static constexpr std::size_t count = N;
};

template <> struct Plain<Span> {
    using scalar = Row;
    static constexpr std::size_t count = 2;
};

template <class Tag> struct Plain<Id<Tag>> {
    using scalar = std::uint32_t;
    static constexpr std::size_t count = 2;
};

/// The scalars of a value or of a whole column.
template <class T> typename Plain<T>::scalar* scalars(T& value) {
    static_assert(sizeof(T) == sizeof(typename Plain<T>::scalar) * Plain<T>::count, "the type has padding");
    return reinterpret_cast<typename Plain<T>::scalar*>(&value);
}
template <class T> typename Plain<T>::scalar* scalars(Column<T>& column) {
    static_assert(sizeof(T) == sizeof(typename Plain<T>::scalar) * Plain<T>::count, "the type has padding");
    return reinterpret_cast<typename Plain<T>::scalar*>(column.data());
}

} // namespace kaya
