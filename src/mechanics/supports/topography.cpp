#include "mechanics/common/masses.hpp"
#include "mechanics/supports/topography.hpp"

#include "mechanics/common/remedy.hpp"
#include "model/edit/ties.hpp"
#include "model/measure/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

/// True when the edge is crossed by the horizontal line from the place towards higher x. Both triangles on an edge get the same answer, so
/// that a place on the edge between two triangles is below exactly one of them.
bool crosses(const Vec3& place, const Vec3& one, const Vec3& other) {
    const bool ordered = one.y() < other.y() || (one.y() == other.y() && one.x() < other.x());
    const Vec3 &a = ordered ? one : other, &b = ordered ? other : one;
    if (a.y() > place.y() || b.y() <= place.y()) return false;
    return place.x() < a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

std::array<Vec3, 3> corners(const Model& model, const TriangleCorners& triangle) {
    std::array<Vec3, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = model.gridpoints.position[triangle[k]];
    return x;
}

} // namespace

Overburden::Overburden(const Model& model) : model_(model) {
    const Vec3& gravity = model.settings.gravity;
    if (!(gravity.z() < 0) || std::hypot(gravity.x(), gravity.y()) > 1e-9 * -gravity.z())
        throw Advised("stresses below the surface need gravity, straight down along z", Advice::give_gravity);
    std::vector<double> weight(model.blocks.size()); // per volume
    for (std::size_t b = 0; b < weight.size(); ++b) {
        const double density = density_of(model, static_cast<Row>(b));
        if (!(density > 0))
            throw Advised(fmt::format("block {} (material {}) has no density, so it has no weight",
                                      model.blocks.number[b], model.blocks.material[b]),
                          Advice::give_density, {std::to_string(model.blocks.material[b])});
        weight[b] = -density * gravity.z();
    }
    if (model.gridpoints.empty()) return;
    low_ = high_ = model.gridpoints.position[0];
    for (const Vec3& x : model.gridpoints.position) {
        low_ = low_.cwiseMin(x);
        high_ = high_.cwiseMax(x);
    }
    columns_ =
        static_cast<std::size_t>(std::clamp(std::sqrt(0.5 * static_cast<double>(model.triangles.size())), 1.0, 1000.0));
    above_.resize(columns_ * columns_);
    const CellFaces faces(model, tied_faces(model));
    for (Row t = 0; t < static_cast<Row>(model.triangles.size()); ++t)
        faces.for_parts(t, true, [&](const SurfacePart& part) {
            parts_.push_back({part.corners, part.share * weight[model.faces.block[model.triangles.face[t]]]});
        });
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const auto x = corners(model, parts_[p].corners);
        const Vec3 from = x[0].cwiseMin(x[1]).cwiseMin(x[2]), to = x[0].cwiseMax(x[1]).cwiseMax(x[2]);
        for (int j = index(from.y(), 1); j <= index(to.y(), 1); ++j)
            for (int i = index(from.x(), 0); i <= index(to.x(), 0); ++i) above_[cell(i, j)].push_back(p);
    }
}

int Overburden::index(double place, int axis) const {
    const double size = high_[axis] - low_[axis];
    const double part = size > 0 ? (place - low_[axis]) / size : 0;
    return static_cast<int>(std::clamp(part * static_cast<double>(columns_), 0.0, static_cast<double>(columns_ - 1)));
}

double Overburden::at(const Vec3& place) const {
    if (above_.empty()) return 0;
    double sum = 0;
    for (const std::size_t p : above_[cell(index(place.x(), 0), index(place.y(), 1))]) {
        const auto x = corners(model_, parts_[p].corners);
        const int crossed = crosses(place, x[0], x[1]) + crosses(place, x[1], x[2]) + crosses(place, x[2], x[0]);
        if (crossed % 2 == 0) continue; // neither above nor below
        const Vec3 area = triangle_area_vector(x[0], x[1], x[2]);
        if (std::abs(area.z()) <= 1e-12 * area.norm()) continue; // upright
        const Vec3 along = place - x[0];
        const double height = x[0].z() - (area.x() * along.x() + area.y() * along.y()) / area.z() - place.z();
        if (height > 0) sum += std::copysign(parts_[p].weight * height, area.z());
    }
    return sum;
}

} // namespace kaya
