#include "geometry/ground/ground.hpp"

#include "base/diagnostic.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace kaya {

namespace {

/// A triangle whose plan area is smaller than this part of its area is vertical.
constexpr double upright = 1e-9;
constexpr std::size_t most_cells = 4096; ///< along one axis

double plan_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * ((b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y()));
}

double area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a, v = c - a;
    return 0.5 * std::sqrt(std::max(0.0, u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v)));
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Parts = CGAL::Triangulation_data_structure_2<Vertices, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Plan = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Parts,
                                                        CGAL::No_constraint_intersection_requiring_constructions_tag>;

} // namespace

Ground::Ground(std::vector<Vec3> corners, std::vector<std::array<int, 3>> triangles) : corners_(std::move(corners)) {
    for (const Vec3& corner : corners_)
        if (!corner.allFinite()) throw Diagnostic("a corner of the surface is not a number");
    for (auto& t : triangles) {
        const Vec3 &a = corners_[static_cast<std::size_t>(t[0])], &b = corners_[static_cast<std::size_t>(t[1])],
                   &c = corners_[static_cast<std::size_t>(t[2])];
        const double plan = plan_area(a, b, c);
        if (!(std::abs(plan) > upright * area(a, b, c))) continue;
        if (plan < 0) std::swap(t[1], t[2]);
        triangles_.push_back(t);
    }
    if (triangles_.empty())
        throw Diagnostic("the surface has no triangle that is not upright",
                         "a ground surface has one height at each place");
    sort_in();
}

Ground Ground::restored(std::vector<Vec3> corners, std::vector<std::array<int, 3>> triangles) {
    const auto there = [&](int corner) { return corner >= 0 && static_cast<std::size_t>(corner) < corners.size(); };
    if (!std::ranges::all_of(triangles, [&](const auto& t) { return std::ranges::all_of(t, there); })) return {};
    try {
        return {std::move(corners), std::move(triangles)};
    } catch (const Diagnostic&) { return {}; }
}

Ground Ground::of_points(const std::vector<std::vector<Vec3>>& lines) {
    std::map<std::array<double, 2>, int> known;
    std::vector<Vec3> corners;
    std::vector<std::vector<int>> rows;
    for (const auto& line : lines) {
        auto& row = rows.emplace_back();
        for (const Vec3& point : line) {
            if (!point.allFinite()) throw Diagnostic("a point of the surface is not a number");
            const auto [at, fresh] = known.try_emplace({point.x(), point.y()}, static_cast<int>(corners.size()));
            if (fresh) corners.push_back(point);
            else
                corners[static_cast<std::size_t>(at->second)].z() =
                    std::max(corners[static_cast<std::size_t>(at->second)].z(), point.z());
            row.push_back(at->second);
        }
    }
    Plan plan;
    std::vector<Plan::Vertex_handle> vertices;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        vertices.push_back(plan.insert({corners[i].x(), corners[i].y()}));
        vertices.back()->info() = static_cast<int>(i);
    }
    if (plan.dimension() < 2)
        throw Diagnostic("the points of the surface lie on one line in the plan",
                         "a surface needs three or more that do not");
    try {
        for (const auto& row : rows)
            for (std::size_t i = 1; i < row.size(); ++i)
                if (row[i] != row[i - 1])
                    plan.insert_constraint(vertices[static_cast<std::size_t>(row[i - 1])],
                                           vertices[static_cast<std::size_t>(row[i])]);
    } catch (const Plan::Intersection_of_constraints_exception&) {
        throw Diagnostic(
            "two lines of the surface cross each other in the plan",
            "contour lines never do; write points that belong to no line apart, with blank lines between them");
    }
    std::vector<std::array<int, 3>> triangles;
    for (const auto face : plan.finite_face_handles())
        triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::ranges::sort(triangles);
    return {std::move(corners), std::move(triangles)};
}

std::size_t Ground::cell(double value, int axis) const {
    const auto k = static_cast<std::size_t>(axis);
    const double at = std::floor((value - low_[k]) / width_[k]);
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(cells_[k] - 1)));
}

void Ground::sort_in() {
    std::array<double, 2> high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    low_ = {-high[0], -high[1]};
    for (const auto& t : triangles_)
        for (const int corner : t)
            for (std::size_t k = 0; k < 2; ++k) {
                low_[k] = std::min(low_[k], corners_[static_cast<std::size_t>(corner)][static_cast<int>(k)]);
                high[k] = std::max(high[k], corners_[static_cast<std::size_t>(corner)][static_cast<int>(k)]);
            }
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(triangles_.size()))));
    for (std::size_t k = 0; k < 2; ++k) {
        cells_[k] = std::clamp<std::size_t>(side, 1, most_cells);
        width_[k] = std::max((high[k] - low_[k]) / static_cast<double>(cells_[k]), std::numeric_limits<double>::min());
    }
    in_cell_.assign(cells_[0] * cells_[1], {});
    std::map<std::array<int, 2>, int> edges;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const auto& t = triangles_[i];
        std::array<double, 2> least = high, most = low_;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& corner = corners_[static_cast<std::size_t>(t[k])];
            for (int axis = 0; axis < 2; ++axis) {
                least[static_cast<std::size_t>(axis)] = std::min(least[static_cast<std::size_t>(axis)], corner[axis]);
                most[static_cast<std::size_t>(axis)] = std::max(most[static_cast<std::size_t>(axis)], corner[axis]);
            }
            ++edges[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}];
        }
        for (std::size_t x = cell(least[0], 0); x <= cell(most[0], 0); ++x)
            for (std::size_t y = cell(least[1], 1); y <= cell(most[1], 1); ++y)
                in_cell_[x * cells_[1] + y].push_back(static_cast<int>(i));
    }
    rim_.clear();
    for (const auto& [edge, count] : edges)
        if (count == 1) rim_.push_back(edge);
}

std::optional<double> Ground::height(double x, double y) const {
    if (triangles_.empty()) return std::nullopt;
    std::optional<double> highest;
    for (const int i : in_cell_[cell(x, 0) * cells_[1] + cell(y, 1)]) {
        const auto& t = triangles_[static_cast<std::size_t>(i)];
        const Vec3 &a = corners_[static_cast<std::size_t>(t[0])], &b = corners_[static_cast<std::size_t>(t[1])],
                   &c = corners_[static_cast<std::size_t>(t[2])];
        const Vec3 place(x, y, 0);
        const double whole = plan_area(a, b, c), edge = 1e-12 * whole;
        const double u = plan_area(place, b, c), v = plan_area(a, place, c), w = plan_area(a, b, place);
        if (u < -edge || v < -edge || w < -edge) continue;
        const double z = (u * a.z() + v * b.z() + w * c.z()) / (u + v + w);
        if (!highest || z > *highest) highest = z;
    }
    return highest;
}

double Ground::height_beyond(double x, double y) const {
    if (const auto inside = height(x, y)) return *inside;
    double best = std::numeric_limits<double>::infinity(), z = 0;
    for (const auto& edge : rim_) {
        const Vec3 &a = corners_[static_cast<std::size_t>(edge[0])], &b = corners_[static_cast<std::size_t>(edge[1])];
        const double dx = b.x() - a.x(), dy = b.y() - a.y(), length = dx * dx + dy * dy;
        const double part = length > 0 ? std::clamp(((x - a.x()) * dx + (y - a.y()) * dy) / length, 0.0, 1.0) : 0.0;
        const double far = std::hypot(x - a.x() - part * dx, y - a.y() - part * dy);
        if (far < best) best = far, z = a.z() + part * (b.z() - a.z());
    }
    return z;
}

std::vector<int> Ground::near(double x_low, double x_high, double y_low, double y_high) const {
    std::vector<int> found;
    if (triangles_.empty()) return found;
    for (std::size_t x = cell(x_low, 0); x <= cell(x_high, 0); ++x)
        for (std::size_t y = cell(y_low, 1); y <= cell(y_high, 1); ++y) {
            const auto& here = in_cell_[x * cells_[1] + y];
            found.insert(found.end(), here.begin(), here.end());
        }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

void Ground::move(const Vec3& shift) {
    for (Vec3& corner : corners_) corner += shift;
    sort_in();
}

} // namespace kaya
