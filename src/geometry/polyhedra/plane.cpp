#include "geometry/polyhedra/plane.hpp"

#include <cmath>
#include <numbers>

namespace kaya {
namespace {

/// sin of an angle in degrees; exact at multiples of 30, so that a vertical joint is vertical.
double sin_degrees(double degrees) {
    double angle = std::fmod(degrees, 360.0);
    if (angle < 0) angle += 360;
    double sign = 1;
    if (angle >= 180) {
        angle -= 180;
        sign = -1;
    }
    if (angle > 90) angle = 180 - angle;
    if (angle == 0) return 0;
    if (angle == 30) return 0.5 * sign;
    if (angle == 90) return sign;
    return sign * std::sin(angle * std::numbers::pi / 180);
}

} // namespace

Vec3 normal_from_dip(double dip, double dip_direction) {
    const double sin_dip = sin_degrees(dip);
    return {sin_dip * sin_degrees(dip_direction), sin_dip * sin_degrees(dip_direction + 90), sin_degrees(dip + 90)};
}

} // namespace kaya
