// Measured values to draw from.
#pragma once

#include "geometry/polyhedra/random.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace kaya {

/// Values with the sum of all weights up to each of them; the sums grow.
template <class T> struct Sample {
    std::vector<T> values = {};
    std::vector<double> sums = {};

    /// `weight` is above 0.
    void add(T value, double weight = 1) {
        values.push_back(std::move(value));
        sums.push_back((sums.empty() ? 0 : sums.back()) + weight);
    }
    /// A value with a probability in proportion to its weight. There is one at least.
    const T& draw(Random& random) const {
        const auto above = std::ranges::upper_bound(sums, random.uniform() * sums.back());
        return values[std::min(static_cast<std::size_t>(above - sums.begin()), values.size() - 1)];
    }
    bool operator==(const Sample&) const = default;
};

/// The orientation of a plane, in degrees: dip from 0 to 90, dip direction from 0 to less than 360.
struct MeasuredPlane {
    double dip = 0, dip_direction = 0;

    bool operator==(const MeasuredPlane&) const = default;
};

} // namespace kaya
