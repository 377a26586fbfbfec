// Eight numbers at a time: rows of zones and gridpoints in the widest vector registers available. Every operation is lane by lane, as in
// model/tables/lanes.hpp, so results do not depend on the width of the registers.
#pragma once

#include "model/tables/column.hpp"
#include "model/tables/lanes.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

// Narrower registers change how these are passed; only inlined functions pass them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace kaya {

using Eight [[gnu::vector_size(64)]] = double;
using Four = Lanes;
using Two [[gnu::vector_size(16)]] = double;
constexpr std::ptrdiff_t eight = 8;
using Eight3 = LaneVector<Eight>;

inline Eight eights(double value) { return Eight{value, value, value, value, value, value, value, value}; }

/// Up to eight rows of a column. Missing rows read as 0 and are not written.
[[gnu::always_inline]] inline Eight load_rows(const double* column, std::ptrdiff_t count) {
    if (count >= eight) return load_as<Eight>(column);
    Eight e{};
    for (std::ptrdiff_t l = 0; l < count; ++l) e[l] = column[l];
    return e;
}
[[gnu::always_inline]] inline void store_rows(double* column, std::ptrdiff_t count, const Eight& e) {
    if (count >= eight) return store(column, e);
    for (std::ptrdiff_t l = 0; l < count; ++l) column[l] = e[l];
}

/// Up to eight rows of columns: usually one joint between rigid blocks. Missing rows read as 0 and are not written.
class RowsOfEight {
public:
    explicit RowsOfEight(std::ptrdiff_t rows) : rows_(rows < eight ? rows : eight) {}

    Eight load(const double* column) const {
#if defined(__AVX512F__)
        return _mm512_maskz_loadu_pd(mask(), column);
#else
        return load_rows(column, rows_);
#endif
    }
    Eight3 load(const VectorColumn& column, std::ptrdiff_t first) const {
        const auto& c = column.component;
        return {load(c[0].data() + first), load(c[1].data() + first), load(c[2].data() + first)};
    }
    /// Missing rows read as `otherwise`.
    Eight load(const double* column, const Eight& otherwise) const {
#if defined(__AVX512F__)
        return _mm512_mask_loadu_pd(otherwise, mask(), column);
#else
        Eight e = otherwise;
        for (std::ptrdiff_t l = 0; l < rows_; ++l) e[l] = column[l];
        return e;
#endif
    }
    Eight3 load(const VectorColumn& column, std::ptrdiff_t first, const Eight3& otherwise) const {
        const auto& c = column.component;
        return {load(c[0].data() + first, otherwise.x), load(c[1].data() + first, otherwise.y),
                load(c[2].data() + first, otherwise.z)};
    }
    void store(double* column, const Eight& e) const {
#if defined(__AVX512F__)
        _mm512_mask_storeu_pd(column, mask(), e);
#else
        store_rows(column, rows_, e);
#endif
    }
    void store(VectorColumn& column, std::ptrdiff_t first, const Eight3& e) const {
        auto& c = column.component;
        store(c[0].data() + first, e.x);
        store(c[1].data() + first, e.y);
        store(c[2].data() + first, e.z);
    }
    std::ptrdiff_t rows() const { return rows_; }

    /// Whether one of the present rows is below, or not above, the limit.
    bool any_below(const Eight& value, const Eight& limit) const {
#if defined(__AVX512F__)
        return _mm512_mask_cmp_pd_mask(mask(), value, limit, _CMP_LT_OQ) != 0;
#else
        bool any = false;
        for (std::ptrdiff_t l = 0; l < rows_; ++l) any |= value[l] < limit[l];
        return any;
#endif
    }
    bool any_not_above(const Eight& value, const Eight& limit) const {
#if defined(__AVX512F__)
        return _mm512_mask_cmp_pd_mask(mask(), value, limit, _CMP_LE_OQ) != 0;
#else
        bool any = false;
        for (std::ptrdiff_t l = 0; l < rows_; ++l) any |= value[l] <= limit[l];
        return any;
#endif
    }

private:
#if defined(__AVX512F__)
    __mmask8 mask() const { return static_cast<__mmask8>((1u << rows_) - 1u); }
#endif
    std::ptrdiff_t rows_;
};

/// Result of a comparison: all bits or none in each lane.
using MaskOfEight = decltype(Eight{} < Eight{});
inline bool all(const MaskOfEight& mask) {
#if defined(__AVX512F__)
    return _mm512_movepi64_mask(reinterpret_cast<const __m512i&>(mask)) == 0xff;
#else
    bool every = true;
    for (int l = 0; l < eight; ++l) every &= mask[l] != 0;
    return every;
#endif
}
inline bool all(bool one) { return one; }

/// The same vector in all rows.
inline Eight3 eights(const Vec3& v) { return {eights(v.x()), eights(v.y()), eights(v.z())}; }

inline Eight larger_of(const Eight& a, const Eight& b) { return a > b ? a : b; }
inline double largest(const Eight& e) {
    const Eight four = larger_of(e, __builtin_shufflevector(e, e, 4, 5, 6, 7, 0, 1, 2, 3));
    const Eight two = larger_of(four, __builtin_shufflevector(four, four, 2, 3, 0, 1, 6, 7, 4, 5));
    return two[0] > two[1] ? two[0] : two[1];
}

inline Eight joined(const Four& low, const Four& high) {
#if defined(__AVX512F__)
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    Eight e;
    std::memcpy(&e, &low, sizeof low);
    std::memcpy(reinterpret_cast<char*>(&e) + sizeof low, &high, sizeof high);
    return e;
#endif
}
inline Four low_half(const Eight& e) {
    Four f;
    std::memcpy(&f, &e, sizeof f);
    return f;
}
inline Four high_half(const Eight& e) {
#if defined(__AVX512F__)
    return __builtin_shufflevector(e, e, 4, 5, 6, 7);
#else
    Four f;
    std::memcpy(&f, reinterpret_cast<const char*>(&e) + sizeof f, sizeof f);
    return f;
#endif
}

inline Eight square_root(const Eight& e) {
#if defined(__AVX512F__)
    return _mm512_maskz_sqrt_pd(0xff, e);
#else
    Eight r;
    for (int l = 0; l < eight; ++l) r[l] = std::sqrt(e[l]);
    return r;
#endif
}

/// Whether all lanes are above 0; false for NaN.
inline bool all_above_zero(const Eight& e) {
#if defined(__AVX512F__)
    return _mm512_cmp_pd_mask(e, _mm512_setzero_pd(), _CMP_GT_OQ) == 0xff;
#else
    bool all = true;
    for (int l = 0; l < eight; ++l) all &= e[l] > 0;
    return all;
#endif
}

inline bool all_zero(const Eight& e) {
#if defined(__AVX512F__)
    return _mm512_cmp_pd_mask(e, _mm512_setzero_pd(), _CMP_NEQ_UQ) == 0;
#else
    bool all = true;
    for (int l = 0; l < eight; ++l) all &= e[l] == 0;
    return all;
#endif
}
/// Whether all bits of some rows are 0: eight, or another count whose size is a multiple of eight bytes.
template <class Number>
[[gnu::always_inline]] inline bool all_zero_rows(const Number* rows, std::ptrdiff_t count = eight) {
    const std::size_t words = static_cast<std::size_t>(count) * sizeof(Number) / sizeof(std::uint64_t);
    std::uint64_t any = 0;
    for (std::size_t w = 0; w < words; ++w) {
        std::uint64_t word;
        std::memcpy(&word, reinterpret_cast<const char*>(rows) + sizeof word * w, sizeof word);
        any |= word;
    }
    return any == 0;
}
inline bool all_zero(const Eight3& e) {
#if defined(__AVX512F__)
    return _mm512_cmp_pd_mask(_mm512_or_pd(_mm512_or_pd(e.x, e.y), e.z), _mm512_setzero_pd(), _CMP_NEQ_UQ) == 0;
#else
    return all_zero(e.x) && all_zero(e.y) && all_zero(e.z);
#endif
}

/// Four rows, or the same numbers as four columns of them.
inline void transpose(std::array<Four, 4>& r) {
    const Four xz01 = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6),
               xz23 = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6);
    const Four yw01 = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7),
               yw23 = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
    r = {__builtin_shufflevector(xz01, xz23, 0, 1, 4, 5), __builtin_shufflevector(yw01, yw23, 0, 1, 4, 5),
         __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7), __builtin_shufflevector(yw01, yw23, 2, 3, 6, 7)};
}

/// Eight rows of four numbers as four columns of eight.
inline std::array<Eight, 4> columns_of_rows(const std::array<Four, 8>& r) {
#if defined(__AVX512F__)
    const Eight a = joined(r[0], r[4]), b = joined(r[1], r[5]), c = joined(r[2], r[6]), d = joined(r[3], r[7]);
    const Eight xz01 = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14),
                yw01 = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight xz23 = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14),
                yw23 = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    return {__builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(yw01, yw23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15),
            __builtin_shufflevector(yw01, yw23, 2, 3, 10, 11, 6, 7, 14, 15)};
#else
    std::array<Four, 4> low{r[0], r[1], r[2], r[3]}, high{r[4], r[5], r[6], r[7]};
    transpose(low);
    transpose(high);
    return {joined(low[0], high[0]), joined(low[1], high[1]), joined(low[2], high[2]), joined(low[3], high[3])};
#endif
}

/// The opposite.
inline std::array<Four, 8> rows_of_columns(const std::array<Eight, 4>& c) {
    std::array<Four, 4> low{low_half(c[0]), low_half(c[1]), low_half(c[2]), low_half(c[3])};
    std::array<Four, 4> high{high_half(c[0]), high_half(c[1]), high_half(c[2]), high_half(c[3])};
    transpose(low);
    transpose(high);
    return {low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]};
}

/// Eight rows of six numbers, which begin `stride` numbers after each other, as six columns.
[[gnu::always_inline]] inline std::array<Eight, 6> six_columns(const double* rows, std::size_t stride) {
    std::array<Four, 8> first;
    for (std::size_t l = 0; l < 8; ++l) first[l] = load_as<Four>(rows + stride * l);
    const std::array<Eight, 4> c = columns_of_rows(first);
    const auto pair = [&](std::size_t l) { return load_as<Two>(rows + stride * l + 4); };
    const auto four = [](const Two& a, const Two& b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3); };
    const Eight even = joined(four(pair(0), pair(2)), four(pair(4), pair(6))),
                odd = joined(four(pair(1), pair(3)), four(pair(5), pair(7)));
    return {c[0],
            c[1],
            c[2],
            c[3],
            __builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14),
            __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15)};
}

/// The opposite; with `copies` the same six numbers that many times in each row.
[[gnu::always_inline]] inline void put_six_columns(double* rows, std::size_t stride, const std::array<Eight, 6>& c,
                                                   std::size_t copies = 1) {
    const std::array<Four, 8> first = rows_of_columns({c[0], c[1], c[2], c[3]});
    const Eight even = __builtin_shufflevector(c[4], c[5], 0, 8, 2, 10, 4, 12, 6, 14),
                odd = __builtin_shufflevector(c[4], c[5], 1, 9, 3, 11, 5, 13, 7, 15);
    for (std::size_t l = 0; l < 8; ++l) {
        const Eight& pairs = l % 2 == 0 ? even : odd;
        const Four half = l < 4 ? low_half(pairs) : high_half(pairs);
        const Two last =
            l % 4 < 2 ? Two(__builtin_shufflevector(half, half, 0, 1)) : Two(__builtin_shufflevector(half, half, 2, 3));
        for (std::size_t n = 0; n < copies; ++n) {
            store(rows + stride * l + 6 * n, first[l]);
            store(rows + stride * l + 6 * n + 4, last);
        }
    }
}

/// Eight rows of three numbers that follow each other, as they lie in memory.
using ThreeEights = std::array<Eight, 3>;
inline ThreeEights load_three(const double* rows) {
    return {load_as<Eight>(rows), load_as<Eight>(rows + 8), load_as<Eight>(rows + 16)};
}
inline void store(double* rows, const ThreeEights& e) {
    for (std::size_t i = 0; i < 3; ++i) store(rows + 8 * i, e[i]);
}
/// The same as three columns of eight.
inline Eight3 columns_of(const ThreeEights& e) {
    const auto pick = [&]<int... a, int... b>(std::integer_sequence<int, a...>, std::integer_sequence<int, b...>) {
        return __builtin_shufflevector(__builtin_shufflevector(e[0], e[1], a...), e[2], b...);
    };
    return {pick(std::integer_sequence<int, 0, 3, 6, 9, 12, 15, 0, 0>{},
                 std::integer_sequence<int, 0, 1, 2, 3, 4, 5, 10, 13>{}),
            pick(std::integer_sequence<int, 1, 4, 7, 10, 13, 0, 0, 0>{},
                 std::integer_sequence<int, 0, 1, 2, 3, 4, 8, 11, 14>{}),
            pick(std::integer_sequence<int, 2, 5, 8, 11, 14, 0, 0, 0>{},
                 std::integer_sequence<int, 0, 1, 2, 3, 4, 9, 12, 15>{})};
}
/// The opposite.
inline ThreeEights three_of(const Eight3& c) {
    const auto pick = [&]<int... a, int... b>(std::integer_sequence<int, a...>, std::integer_sequence<int, b...>) {
        return __builtin_shufflevector(__builtin_shufflevector(c.x, c.y, a...), c.z, b...);
    };
    return {pick(std::integer_sequence<int, 0, 8, 0, 1, 9, 0, 2, 10>{},
                 std::integer_sequence<int, 0, 1, 8, 3, 4, 9, 6, 7>{}),
            pick(std::integer_sequence<int, 0, 3, 11, 0, 4, 12, 0, 5>{},
                 std::integer_sequence<int, 10, 1, 2, 11, 4, 5, 12, 7>{}),
            pick(std::integer_sequence<int, 13, 0, 6, 14, 0, 7, 15, 0>{},
                 std::integer_sequence<int, 0, 13, 2, 3, 14, 5, 6, 15>{})};
}
/// A number of each row for each of its three.
inline ThreeEights for_each_of_three(const Eight& e) {
    return {__builtin_shufflevector(e, e, 0, 0, 0, 1, 1, 1, 2, 2),
            __builtin_shufflevector(e, e, 2, 3, 3, 3, 4, 4, 4, 5),
            __builtin_shufflevector(e, e, 5, 5, 6, 6, 6, 7, 7, 7)};
}
/// The same three numbers for each row.
inline ThreeEights for_each_row(const Vec3& v) {
    const double x = v.x(), y = v.y(), z = v.z();
    return {Eight{x, y, z, x, y, z, x, y}, Eight{z, x, y, z, x, y, z, x}, Eight{y, z, x, y, z, x, y, z}};
}
inline Eight size_of(const Eight& e) { return e < 0 ? -e : e; }
inline double sum(const Eight& e) { return ((e[0] + e[1]) + (e[2] + e[3])) + ((e[4] + e[5]) + (e[6] + e[7])); }
inline Vec3 sum(const Eight3& e) { return {sum(e.x), sum(e.y), sum(e.z)}; }

/// The sums of eight vectors, each as `sum` adds it: neighbours first, then pairs of pairs.
inline Eight sums_of(const std::array<Eight, 8>& e) {
    const auto neighbours = [](const Eight& a, const Eight& b) {
        return Eight(__builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
                     __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15));
    };
    const auto pairs = [](const Eight& a, const Eight& b) {
        return Eight(__builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13) +
                     __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15));
    };
    const Eight low = pairs(neighbours(e[0], e[1]), neighbours(e[2], e[3])),
                high = pairs(neighbours(e[4], e[5]), neighbours(e[6], e[7]));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 8, 9, 10, 11) +
           __builtin_shufflevector(low, high, 4, 5, 6, 7, 12, 13, 14, 15);
}

/// Adds the eight to sums of four in a fixed order: the first four, then the others.
inline void add_to(Lanes& sum, const Eight& e) {
    sum += low_half(e);
    sum += high_half(e);
}

} // namespace kaya
