#include "model/structures/lining.hpp"

#include "model/measure/measure.hpp"
#include "model/structures/rock_points.hpp"
#include "model/tables/model.hpp"
#include "model/kinds/selection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace kaya {

namespace {

using Corners = std::array<Vec3, 3>;

double area_of(const Corners& c) { return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm(); }

Vec3 middle_of(const Corners& c) { return (c[0] + c[1] + c[2]) / 3; }

Vec3 normal_of(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]).normalized(); }

/// Whether blocks cover a triangle of a face: tested just in front of its middle, and near its corners. Several blocks may cover it.
class Cover {
public:
    Cover(const Model& model, double tolerance)
        : finder_(model), tolerance_(tolerance), in_front_(2 * std::max(tolerance, on_surface * model_size(model))) {}
    bool at(const Vec3& place, const Vec3& normal) const {
        return finder_.at(place + in_front_ * normal, tolerance_) != no_row;
    }
    bool in_the_middle(const Corners& corners) const { return at(middle_of(corners), normal_of(corners)); }
    /// How many of the centre and three points near the corners are covered.
    int count(const Corners& corners) const {
        const Vec3 middle = middle_of(corners), normal = normal_of(corners);
        int covered = at(middle, normal);
        for (const Vec3& corner : corners) covered += at(corner + 0.15 * (middle - corner), normal);
        return covered;
    }
    static constexpr int all = 4;

private:
    static constexpr double on_surface = 1e-6; ///< as in rock_points.cpp: nearer places count as in the block

    BlockFinder finder_;
    double tolerance_, in_front_;
};

double extent_of(const std::vector<Corners>& triangles) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const auto& corners : triangles)
        for (const Vec3& corner : corners) {
            low = low.cwiseMin(corner);
            high = high.cwiseMax(corner);
        }
    return triangles.empty() ? 0 : (high - low).norm();
}

} // namespace

std::vector<Row> triangles_to_line(const Model& model, const std::vector<Row>& faces,
                                   const std::vector<Row>& gridpoints) {
    std::vector<Row> rows;
    const auto named = [&](Row g) { return std::ranges::binary_search(gridpoints, g); };
    for (Row t = 0; t < static_cast<Row>(model.triangles.size()); ++t)
        if (std::ranges::binary_search(faces, model.triangles.face[t]) ||
            std::ranges::all_of(model.triangles.gridpoints[t], named))
            rows.push_back(t);
    return rows;
}

double expected_triangles(const Model& model, const std::vector<Row>& rows, double edge) {
    double area = 0;
    for (const Row t : rows) area += triangle_area_vector(model, t).norm();
    return std::max(static_cast<double>(rows.size()), edge > 0 ? 4 * area / (edge * edge) : 0);
}

Lining line_triangles(const Model& model, const std::vector<Row>& rows, double edge, double& tolerance) {
    Lining lining;
    std::vector<Corners> triangles;
    for (const Row t : rows) {
        const auto& corners = model.triangles.gridpoints[t];
        const auto& position = model.gridpoints.position;
        triangles.push_back({position[corners[0]], position[corners[1]], position[corners[2]]});
    }
    if (!(tolerance > 0)) tolerance = 1e-4 * extent_of(triangles);
    const Cover cover(model, tolerance);
    std::vector<Corners> open;
    for (const Corners& triangle : triangles)
        if (cover.count(triangle) == Cover::all) ++lining.covered;
        else open.push_back(triangle);
    lining.mesh = joined_surface(open, tolerance);
    cut_at_corners(lining.mesh, tolerance);
    if (edge > 0) refine(lining.mesh, edge);

    std::vector<char> kept;
    for (const auto& t : lining.mesh.triangles) {
        const auto at = [&](std::size_t k) { return lining.mesh.points[static_cast<std::size_t>(t[k])]; };
        const Corners corners{at(0), at(1), at(2)};
        const int covered = cover.count(corners);
        const bool out = cover.in_the_middle(corners);
        kept.push_back(!out);
        lining.partly += covered != 0 && covered != Cover::all;
        if (out) ++lining.covered;
        else lining.area += area_of(corners);
    }
    keep_triangles(lining.mesh, kept);
    return lining;
}

} // namespace kaya
