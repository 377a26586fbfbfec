#include "geometry/mesh/edge_field.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace kaya {
namespace {

constexpr double least_growth = 0.25; ///< of an edge with the distance, beyond that of the field
constexpr int steps = 256;            ///< of the integrals over an edge

/// How far the nearest and the farthest place of a box are from a place.
std::array<double, 2> distances_of_box(const Box& box, const Vec3& place) {
    const auto& [low, high] = box;
    return {(low - place).cwiseMax(place - high).cwiseMax(0).norm(),
            (low - place).cwiseAbs().cwiseMax((high - place).cwiseAbs()).norm()};
}

} // namespace

double EdgeField::change() const {
    return even() ? 0 : std::max(std::abs(at_distance - at_center) / distance, least_growth);
}

double EdgeField::at_radius(double r) const {
    if (r <= distance) return at_center + (at_distance - at_center) / distance * r;
    const double growth = change() * (r - distance);
    return at_distance < edge ? std::min(edge, at_distance + growth) : std::max(edge, at_distance - growth);
}

double EdgeField::least_in(const Box& box) const {
    if (even()) return edge;
    const auto [near, far] = distances_of_box(box, center);
    return std::min({at_radius(near), at_radius(far), at_radius(std::clamp(distance, near, far))});
}

double EdgeField::cubes_in(const Polyhedron& block) const {
    const double volume = mass_properties(block).volume;
    if (even()) return volume / (edge * edge * edge);
    // The mean over shells around the centre, from the nearest place of a box around the block to the farthest one.
    const auto [near, far] = distances_of_box(box_around(block.vertices), center);
    double cubes = 0, whole = 0;
    for (int i = 0; i < steps; ++i) {
        const auto radius = [near = near, far = far](double t) { return near + t * t * (far - near); };
        const double r = radius((i + 0.5) / steps), size = at_radius(r);
        const double shell = r * r * (radius((i + 1.0) / steps) - radius(static_cast<double>(i) / steps));
        cubes += shell / (size * size * size);
        whole += shell;
    }
    return volume * cubes / whole;
}

void EdgeField::check() const {
    const auto require = [](double x, const char* what) {
        if (!(x > 0) || !std::isfinite(x))
            throw Diagnostic(fmt::format("the {} of zones is {}, and must be above 0", what, x));
    };
    require(edge, "edge length");
    if (even()) return;
    require(at_center, "edge length at the center");
    require(at_distance, "edge length at the distance");
    require(distance, "distance from the center of the edges");
    // Zones that grow by more from one to the next would be flat or sharp.
    if (std::abs(at_distance - at_center) > distance)
        throw Diagnostic(fmt::format("edges of zones cannot change from {} to {} over a distance of {}", at_center,
                                     at_distance, distance),
                         "give a distance that is not shorter than the change of the edge length");
    if (!center.allFinite()) throw Diagnostic("the center of the edges of zones is not a finite point");
}

EdgeParts::EdgeParts(const EdgeField& field, const Vec3& from, const Vec3& to) : edges_(1) {
    const double length = (to - from).norm();
    if (field.even()) {
        sum_ = length / field.edge;
        return;
    }
    along_.push_back(0);
    for (int i = 0; i < steps; ++i)
        along_.push_back(along_.back() + length / steps / field.at(from + ((i + 0.5) / steps) * (to - from)));
    sum_ = along_.back();
}

void EdgeParts::add(const EdgeParts& other, bool turned) {
    sum_ += other.sum_;
    edges_ += other.edges_;
    if (along_.empty()) along_.assign(other.along_.size(), 0);
    for (std::size_t i = 0; i < other.along_.size(); ++i)
        along_[i] += turned ? other.sum_ - other.along_[other.along_.size() - 1 - i] : other.along_[i];
}

std::vector<double> EdgeParts::division(int n, bool turned) const {
    std::vector<double> places;
    std::size_t step = 0;
    for (int i = 0; i <= n; ++i) {
        const double even = static_cast<double>(i) / n;
        if (along_.empty() || i == 0 || i == n) {
            places.push_back(even);
            continue;
        }
        const double wanted = even * sum_;
        while (step + 1 < steps && along_[step + 1] < wanted) ++step;
        places.push_back((static_cast<double>(step) + (wanted - along_[step]) / (along_[step + 1] - along_[step])) /
                         steps);
    }
    if (!turned) return places;
    std::ranges::reverse(places);
    for (double& place : places) place = 1 - place;
    return places;
}

int whole_parts(double parts) { return std::max(1, static_cast<int>(std::lround(parts + 1e-6))); }

} // namespace kaya
