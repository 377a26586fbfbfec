// Four numbers at a time: rows of columns in vector registers. Every operation is row by row, so a result depends neither on the row's
// place in a group nor on the width of the registers.
#pragma once

#include "model/tables/column.hpp"

#include <array>
#include <cstddef>
#if defined(__AVX512VL__)
#include <immintrin.h>
#endif

// The ABI of vectors of eight depends on the registers; only inlined functions pass them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace kaya {

using Lanes = Eigen::Array4d;
constexpr std::ptrdiff_t lane_count = 4;

/// A vector quantity of several rows.
template <class L> struct LaneVector {
    L x, y, z;

    static LaneVector of(const Vec3& v) { return {L::Constant(v.x()), L::Constant(v.y()), L::Constant(v.z())}; }
    L dot(const LaneVector& o) const { return x * o.x + y * o.y + z * o.z; }
    LaneVector cross(const LaneVector& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
    LaneVector operator+(const LaneVector& o) const { return {x + o.x, y + o.y, z + o.z}; }
    LaneVector operator-(const LaneVector& o) const { return {x - o.x, y - o.y, z - o.z}; }
    LaneVector operator*(const L& s) const { return {x * s, y * s, z * s}; }
};
using Lanes3 = LaneVector<Lanes>;

/// Up to four rows of a column. Rows that are not there read as 0 and are not written.
class LaneGroup {
public:
    explicit LaneGroup(std::ptrdiff_t rows) : rows_(rows < lane_count ? rows : lane_count) {}

    Lanes load(const double* column) const {
        if (rows_ == lane_count) return Eigen::Map<const Lanes>(column);
        Lanes lanes = Lanes::Zero();
#if defined(__AVX512VL__)
        _mm256_storeu_pd(lanes.data(), _mm256_maskz_loadu_pd(mask(), column));
#else
        for (std::ptrdiff_t i = 0; i < rows_; ++i) lanes[i] = column[i];
#endif
        return lanes;
    }
    Lanes3 load(const VectorColumn& column, std::ptrdiff_t first) const {
        const auto& c = column.component;
        return {load(c[0].data() + first), load(c[1].data() + first), load(c[2].data() + first)};
    }
    void store(double* column, const Lanes& lanes) const {
        if (rows_ == lane_count) {
            Eigen::Map<Lanes>{column} = lanes;
            return;
        }
#if defined(__AVX512VL__)
        _mm256_mask_storeu_pd(column, mask(), _mm256_loadu_pd(lanes.data()));
#else
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

inline Lanes size_of(const Lanes& lanes) { return lanes.abs(); }

/// In an order that is always the same.
inline double sum(const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }
inline Vec3 sum(const Lanes3& lanes) { return {sum(lanes.x), sum(lanes.y), sum(lanes.z)}; }

} // namespace kaya
