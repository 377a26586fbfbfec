#include "mechanics/common/crushed_zones.hpp"

#include "base/reduce.hpp"
#include "base/number_text.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {

namespace {

constexpr std::size_t zone_grain = 1024;
constexpr double least_volume = 0.2; ///< of the initial volume
const double least_sine = std::sin(2 * std::numbers::pi / 180);

using Corners = std::array<Vec3, 4>;

double volume_of(const Corners& x) { return (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0])) / 6; }

/// Sine of the dihedral angle nearest to 0 or 180 degrees. The cross product of the area vectors of two faces is their common edge times
/// the volume.
double sine_of(const Corners& x) {
    const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
    const double six_volumes = std::abs(a.dot(b.cross(c)));
    const std::array<double, 4> sizes{(b - a).cross(c - a).norm(), b.cross(c).norm(), a.cross(c).norm(),
                                      b.cross(a).norm()}; // of the face opposite to each corner
    double sine = 1;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            // The edge of two faces joins the other two corners.
            const std::size_t k = i != 0 && j != 0 ? 0 : i != 1 && j != 1 ? 1 : 2, l = 6 - i - j - k;
            const double both = sizes[i] * sizes[j];
            sine = std::min(sine, both > 0 ? six_volumes * (x[l] - x[k]).norm() / both : 0);
        }
    return sine;
}

struct Places {
    Corners now, then; ///< then: when displacements were zero
};

Places places_of(const Model& model, Row zone) {
    Places places;
    for (std::size_t k = 0; k < 4; ++k) {
        const Row g = model.zones.gridpoints[zone][k];
        places.now[k] = model.gridpoints.position[g];
        places.then[k] = places.now[k] - model.gridpoints.displacement[g];
    }
    return places;
}

bool is_crushed(const Model& model, Row zone) {
    const auto [now, then] = places_of(model, zone);
    const double volume = volume_of(then);
    if (!(volume > 0)) return false; // displacements were set
    return !(volume_of(now) >= least_volume * volume) || (sine_of(now) < least_sine && sine_of(then) >= least_sine);
}

Diagnostic of_zone(const Model& model, Row zone, const std::string& what) {
    const Row block = model.zones.block[zone];
    const Vec3 place = zone_centroid(model, zone);
    Vec3 velocity = Vec3::Zero();
    for (const Row g : model.zones.gridpoints[zone]) velocity += 0.25 * model.gridpoints.velocity[g];
    Diagnostic d(
        fmt::format("zone {} of block {} at {} {}", zone + 1, model.blocks.number[block], place_text(place), what),
        "look at the velocities and loads that drive the block, or delete what has fallen apart", Fault::run);
    d.code = zone_crushed;
    d.add(fmt::format("it moves with {}; the time step is {:.6g}", vector_text(velocity), model.clock.time_step));
    return d;
}

} // namespace

void check_crushed_zones(const Model& model) {
    if (!model.settings.large_strain) return;
    const Row none = static_cast<Row>(model.zones.size());
    const Row first = reduce_chunks(
        model.zones.size(), zone_grain, none,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t z = begin; z < end; ++z)
                if (is_crushed(model, static_cast<Row>(z))) return static_cast<Row>(z);
            return none;
        },
        [](Row& least, const Row& part) { least = std::min(least, part); });
    if (first == none) return;
    const auto [now, then] = places_of(model, first);
    const double left = volume_of(now) / volume_of(then);
    throw of_zone(model, first,
                  left < least_volume ? fmt::format("is crushed: {:.3g} of its volume is left", left)
                                      : fmt::format("is crushed: two of its faces are {:.2g} degrees from each other",
                                                    std::asin(sine_of(now)) * 180 / std::numbers::pi));
}

Diagnostic turned_over(const Model& model, Row zone) {
    return of_zone(model, zone, "has turned inside out in one step");
}

} // namespace kaya
