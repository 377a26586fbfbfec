// Distributions from which fractures are drawn.
#pragma once

#include "geometry/fractures/disc.hpp"
#include "geometry/fractures/sample.hpp"
#include "geometry/polyhedra/random.hpp"

#include <array>
#include <limits>

namespace kaya {

/// Least and greatest value that is taken.
struct Interval {
    double low, high;
    bool hold(double x) const { return x >= low && x <= high; }
    bool operator==(const Interval&) const = default;
};

/// Dip directions from `low` clockwise to `high`, modulo 360 degrees: -30 to 30, 330 to 390 and 330 to 30 are the same.
struct Directions {
    double low, high;
    /// Of the arc, in degrees.
    double width() const;
    bool hold(double direction) const;
    bool operator==(const Directions&) const = default;
};

/// How fractures are directed and how large they are.
struct FractureLaw {
    enum class Orientation { uniform, fisher, gauss, bootstrapped } orientation = Orientation::uniform;
    double dip = 0, dip_direction = 0; ///< degrees: the mean
    double kappa = 0;                  ///< of Fisher's distribution
    double dip_deviation = 0, dip_direction_deviation = 0;
    Interval dips{0, 90};
    Directions dip_directions{0, 360};
    Sample<MeasuredPlane> planes = {}; ///< of bootstrapped orientations

    enum class Size { power_law, log_normal, gauss, exponential, uniform, bootstrapped } size = Size::uniform;
    double exponent = 0;            ///< of a power law: the density of diameters falls with diameter^-exponent
    double mean = 0, deviation = 0; ///< of the diameter, before the limits
    Interval sizes{1, std::numeric_limits<double>::infinity()};
    Sample<double> diameters = {}; ///< of bootstrapped sizes

    bool operator==(const FractureLaw&) const = default;
};

/// Throws Diagnostic when nothing can be drawn from the law.
void check(const FractureLaw& law);

/// A disc with its centre in the box. Values outside of the limits are drawn again. Throws Diagnostic when the limits leave nothing.
Disc draw(const FractureLaw& law, const Vec3& low, const Vec3& high, Random& random);

} // namespace kaya
