#include "scene/framing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace kaya {

namespace {

using Place = std::array<double, 3>;

double dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Least and greatest of what it has seen.
struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double value) { low = std::min(low, value), high = std::max(high, value); }
    double middle() const { return low <= high ? 0.5 * (low + high) : 0; }
    double size() const { return low <= high ? high - low : 0; }
};

/// Visits all points in the frame of the picture: to the right, upwards, towards the eye.
template <class Visit> void each_point(const Scene& scene, const Framing& framing, Visit visit) {
    const auto put = [&](const Place& place) {
        if (std::isfinite(dot(place, {1, 1, 1})))
            visit(dot(place, framing.right), dot(place, framing.up), dot(place, framing.toward));
    };
    for (const Layer& layer : scene.layers) {
        const bool arrows = layer.vectors.size() == layer.points.size();
        for (std::size_t at = 0; at + 2 < layer.points.size(); at += 3) {
            const Place foot{layer.points[at], layer.points[at + 1], layer.points[at + 2]};
            put(foot);
            if (arrows)
                put({foot[0] + layer.vectors[at], foot[1] + layer.vectors[at + 1], foot[2] + layer.vectors[at + 2]});
        }
    }
}

} // namespace

Framing framing_of(const Scene& scene, const Area& area) {
    constexpr double degree = std::numbers::pi / 180;
    const double dip = scene.dip * degree, direction = scene.dip_direction * degree;
    const double sin_dip = std::sin(dip), cos_dip = std::cos(dip), east = std::sin(direction),
                 north = std::cos(direction);
    Framing framing;
    framing.toward = {sin_dip * east, sin_dip * north, cos_dip};
    framing.up = {-cos_dip * east, -cos_dip * north, sin_dip};
    framing.right = {-north, east, 0};
    const double wide = std::max(area.right - area.left, 1.0), high = std::max(area.top - area.bottom, 1.0);
    const double pixels = 0.5 * scene.height / std::tan(0.5 * view_angle * degree); // from the eye to the picture
    const double flat = 2 * pixels / wide, steep = 2 * pixels / high;
    // From the eye at (a0, b0, c0) a point (a, b, c) is seen at pixels * (a - a0) / (c0 - c): within the area if
    // c0 >= c + flat * |a - a0| and c0 >= c + steep * |b - b0|.
    Range a, b, c, falling_a, rising_a, falling_b, rising_b;
    each_point(scene, framing, [&](double x, double y, double z) {
        a.add(x), b.add(y), c.add(z);
        rising_a.add(z + flat * x), falling_a.add(z - flat * x);
        rising_b.add(z + steep * y), falling_b.add(z - steep * y);
    });
    const double size = std::max({a.size(), b.size(), c.size()});
    const double least = size > 0 ? size : 1;
    Place middle{a.middle(), b.middle(), c.middle()};
    if (scene.perspective && size > 0) {
        middle[0] = 0.5 * (rising_a.high - falling_a.high) / flat;
        middle[1] = 0.5 * (rising_b.high - falling_b.high) / steep;
        const double eye = 0.5 * std::max(rising_a.high + falling_a.high, rising_b.high + falling_b.high);
        framing.distance = std::max(eye - middle[2], 1e-3 * least);
        framing.pixel = framing.distance / pixels;
    } else {
        framing.pixel = std::max({a.size() / wide, b.size() / high, 1e-3 * least / wide});
        framing.distance = 2 * least;
    }
    for (std::size_t k = 0; k < 3; ++k)
        framing.focus[k] =
            scene.has_centre ? scene.centre[k]
                             : middle[0] * framing.right[k] + middle[1] * framing.up[k] + middle[2] * framing.toward[k];
    const double closer = std::max(scene.magnification, 1e-3);
    framing.pixel /= closer;
    if (scene.perspective) framing.distance /= closer;
    return framing;
}

} // namespace kaya
