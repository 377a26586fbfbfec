// Four numbers at a time: rows of columns in vector registers. Every operation is row by row, so a result depends neither on the row's
// place in a group nor on the width of the registers.
#pragma once

#include "model/tables/column.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#if defined(__AVX512VL__)
#include <immintrin.h>
#endif

// The ABI of vectors of eight depends on the registers; only inlined functions pass them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace kaya {

using Lanes [[gnu::vector_size(32)]] = double;
constexpr std::ptrdiff_t lane_count = 4;

template <class Vector> Vector load_as(const double* from) {
    Vector v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
template <class Vector> void store(double* to, const Vector& v) { std::memcpy(to, &v, sizeof v); }

inline Lanes four_times(double value) { return Lanes{value, value, value, value}; }

/// A vector quantity of several rows.
template <class L> struct LaneVector {
    L x, y, z;

    L dot(const LaneVector& o) const { return x * o.x + y * o.y + z * o.z; }
    LaneVector cross(const LaneVector& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
    LaneVector operator+(const LaneVector& o) const { return {x + o.x, y + o.y, z + o.z}; }
    LaneVector operator-(const LaneVector& o) const { return {x - o.x, y - o.y, z - o.z}; }
    LaneVector operator*(const L& s) const { return {x * s, y * s, z * s}; }
};
using Lanes3 = LaneVector<Lanes>;
inline Lanes3 four_times(const Vec3& v) { return {four_times(v.x()), four_times(v.y()), four_times(v.z())}; }

/// Up to four rows of a column. Rows that are not there read as 0 and are not written.
class LaneGroup {
public:
    explicit LaneGroup(std::ptrdiff_t rows) : rows_(rows < lane_count ? rows : lane_count) {}

    Lanes load(const double* column) const {
#if defined(__AVX512VL__)
        return _mm256_maskz_loadu_pd(mask(), column);
#else
        if (rows_ == lane_count) return load_as<Lanes>(column);
        Lanes lanes{};
        for (std::ptrdiff_t i = 0; i < rows_; ++i) lanes[i] = column[i];
        return lanes;
#endif
    }
    Lanes3 load(const VectorColumn& column, std::ptrdiff_t first) const {
        const auto& c = column.component;
        return {load(c[0].data() + first), load(c[1].data() + first), load(c[2].data() + first)};
    }
    void store(double* column, const Lanes& lanes) const {
#if defined(__AVX512VL__)
        _mm256_mask_storeu_pd(column, mask(), lanes);
#else
        if (rows_ == lane_count) return kaya::store(column, lanes);
        for (std::ptrdiff_t i = 0; i < rows_; ++i) column[i] = lanes[i];
#endif
    }
    void store(VectorColumn& column, std::ptrdiff_t first, const Lanes3& lanes) const {
        auto& c = column.component;
        store(c[0].data() + first, lanes.x);
        store(c[1].data() + first, lanes.y);
        store(c[2].data() + first, lanes.z);
    }
    std::ptrdiff_t rows() const { return rows_; }

private:
#if defined(__AVX512VL__)
    __mmask8 mask() const { return static_cast<__mmask8>((1u << rows_) - 1u); }
#endif
    std::ptrdiff_t rows_;
};

inline Lanes size_of(const Lanes& lanes) { return lanes < 0 ? -lanes : lanes; }

/// In an order that is always the same.
inline double sum(const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }
inline Vec3 sum(const Lanes3& lanes) { return {sum(lanes.x), sum(lanes.y), sum(lanes.z)}; }

} // namespace kaya
