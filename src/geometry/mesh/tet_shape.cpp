#include "geometry/mesh/tet_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaya {
double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 ab = b - a, ac = c - a, ad = d - a;
    const double six_volumes = ab.dot(ac.cross(ad));
    const double squares = ab.squaredNorm() + ac.squaredNorm() + ad.squaredNorm() + (c - b).squaredNorm() +
                           (d - b).squaredNorm() + (d - c).squaredNorm();
    if (squares == 0) return 0;
    const double mean_square = squares / 6;
    return std::numbers::sqrt2 * six_volumes / (mean_square * std::sqrt(mean_square));
}

double least_sine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, bool with_shape) {
    const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
    // By the corner opposite: one over the square of twice the area of a face. 6 V times an edge over twice the areas of its two faces is the sine.
    const double fa = 1 / bc.cross(bd).squaredNorm(), fb = 1 / ac.cross(ad).squaredNorm(),
                 fc = 1 / ab.cross(ad).squaredNorm(), fd = 1 / ab.cross(ac).squaredNorm();
    const double six_volumes = ab.dot(ac.cross(ad));
    const double least = std::min({ab.squaredNorm() * fc * fd, ac.squaredNorm() * fb * fd, ad.squaredNorm() * fb * fc,
                                   bc.squaredNorm() * fa * fd, bd.squaredNorm() * fa * fc, cd.squaredNorm() * fa * fb});
    if (!with_shape) {
        const double sine = six_volumes * std::sqrt(least);
        return std::isfinite(sine) ? sine : 0;
    }
    const double mean_square = (ab.squaredNorm() + ac.squaredNorm() + ad.squaredNorm() + bc.squaredNorm() +
                                bd.squaredNorm() + cd.squaredNorm()) /
                               6;
    const double shape = std::numbers::sqrt2 / (mean_square * std::sqrt(mean_square));
    const double quality = six_volumes * std::min(std::sqrt(least), shape);
    return std::isfinite(quality) ? quality : 0;
}

} // namespace kaya
