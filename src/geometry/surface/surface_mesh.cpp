#include "geometry/surface/surface_mesh.hpp"

#include "base/stop_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <unordered_map>
#include <utility>

namespace kaya {

namespace {

using Triangle = std::array<int, 3>;

/// Points by the cells of a grid.
class Grid {
public:
    explicit Grid(double cell) : cell_(cell) {}
    void add(const Vec3& place, int point) { cells_[key(index_of(place))].push_back(point); }
    /// Visits points in the cells that a box reaches; a point may be farther away than the box.
    template <class Visit> void each_in(const Vec3& low, const Vec3& high, const Visit& visit) const {
        const Index first = index_of(low), last = index_of(high);
        for (std::int64_t i = first[0]; i <= last[0]; ++i)
            for (std::int64_t j = first[1]; j <= last[1]; ++j)
                for (std::int64_t k = first[2]; k <= last[2]; ++k)
                    if (const auto found = cells_.find(key({i, j, k})); found != cells_.end())
                        for (const int point : found->second) visit(point);
    }

private:
    using Index = std::array<std::int64_t, 3>;
    Index index_of(const Vec3& place) const {
        return {std::llround(std::floor(place[0] / cell_)), std::llround(std::floor(place[1] / cell_)),
                std::llround(std::floor(place[2] / cell_))};
    }
    /// Cells that share a key are only searched together.
    static std::uint64_t key(const Index& index) {
        std::uint64_t mixed = 0;
        for (const auto part : index) mixed = (mixed ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15U;
        return mixed;
    }

    double cell_;
    std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

double twice_area(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a).norm(); }

double longest_side(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
}

double least_height(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = longest_side(a, b, c);
    return longest > 0 ? twice_area(a, b, c) / longest : 0;
}

/// Triangles of a convex polygon with some collinear corners: the ear with the best shape is cut first, as long as the rest is not a line.
void cut_polygon(const std::vector<Vec3>& points, std::vector<int> polygon, double tolerance,
                 std::vector<Triangle>& triangles) {
    const auto at = [&](int corner) { return points[static_cast<std::size_t>(corner)]; };
    const auto height_without = [&](std::size_t left_out) {
        std::vector<int> rest = polygon;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
        double most = 0;
        for (std::size_t k = 2; k < rest.size(); ++k)
            for (std::size_t j = 1; j < k; ++j)
                most = std::max(most, least_height(at(rest[0]), at(rest[j]), at(rest[k])));
        return most;
    };
    while (polygon.size() > 3) {
        const std::size_t count = polygon.size();
        std::size_t best = count;
        double best_shape = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const Vec3 a = at(polygon[(k + count - 1) % count]), b = at(polygon[k]), c = at(polygon[(k + 1) % count]);
            const double height = least_height(a, b, c);
            if (!(height > tolerance) || !(height_without(k) > tolerance)) continue;
            const double shape = height / longest_side(a, b, c);
            if (shape <= best_shape) continue;
            best = k;
            best_shape = shape;
        }
        if (best == count) return; // too narrow to be cut
        triangles.push_back({polygon[(best + count - 1) % count], polygon[best], polygon[(best + 1) % count]});
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
    }
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
}

Vec3 area_vector(const SurfaceMesh& mesh, const Triangle& t) {
    const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(t[k])]; };
    return (at(1) - at(0)).cross(at(2) - at(0));
}

bool in_one_plane(const SurfaceMesh& mesh, std::size_t one, std::size_t other) {
    constexpr double angle = 1e-3;
    const Vec3 normal = area_vector(mesh, mesh.triangles[one]).normalized();
    return area_vector(mesh, mesh.triangles[other]).normalized().dot(normal) >= 1 - 0.5 * angle * angle;
}

/// Longest-side bisection that stays conforming.
class Refinement {
public:
    Refinement(SurfaceMesh& mesh, double edge) : mesh_(mesh), edge_(edge) {
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) link(t);
    }
    /// Sides that cannot be turned: those of one triangle, or between two planes.
    void halve_borders() {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                while (length_of(side_of(t, k)) > edge_ * edge_ && is_border(side_of(t, k))) halve(side_of(t, k));
    }
    void run() {
        // Halves are appended, so the loop reaches them too.
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            while (length_of(longest_of(t)) > edge_ * edge_) halve_longest(t);
    }

private:
    using Side = std::pair<int, int>;

    static Side side(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
    Side side_of(std::size_t t, std::size_t k) const {
        return side(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]);
    }
    double length_of(const Side& s) const {
        return (mesh_.points[static_cast<std::size_t>(s.first)] - mesh_.points[static_cast<std::size_t>(s.second)])
            .squaredNorm();
    }
    /// A strict order of all sides, also for equal lengths.
    bool longer(const Side& a, const Side& b) const { return std::pair(length_of(a), a) > std::pair(length_of(b), b); }
    Side longest_of(std::size_t t) const {
        Side best = side_of(t, 0);
        for (std::size_t k = 1; k < 3; ++k)
            if (longer(side_of(t, k), best)) best = side_of(t, k);
        return best;
    }
    bool is_border(const Side& s) const {
        const auto& on_side = sides_.at(s);
        return on_side.size() != 2 || !in_one_plane(mesh_, on_side[0], on_side[1]);
    }
    void link(std::size_t t) {
        for (std::size_t k = 0; k < 3; ++k) sides_[side_of(t, k)].push_back(t);
    }
    void unlink(std::size_t t) {
        for (std::size_t k = 0; k < 3; ++k) std::erase(sides_[side_of(t, k)], t);
    }
    /// Halves the longest side of the last triangle on the path from neighbour to neighbour along ever longer sides.
    void halve_longest(std::size_t t) {
        Side longest = longest_of(t);
        for (bool found = true; found;) {
            found = false;
            for (const std::size_t other : sides_.at(longest))
                if (const Side of_other = longest_of(other); longer(of_other, longest)) {
                    longest = of_other;
                    found = true;
                    break;
                }
        }
        halve(longest);
    }
    void halve(const Side& s) {
        stops_.pass();
        const int middle = static_cast<int>(mesh_.points.size());
        mesh_.points.emplace_back(
            0.5 * (mesh_.points[static_cast<std::size_t>(s.first)] + mesh_.points[static_cast<std::size_t>(s.second)]));
        const std::vector<std::size_t> on_side = sides_.at(s);
        for (const std::size_t t : on_side) {
            unlink(t);
            const Triangle whole = mesh_.triangles[t];
            std::size_t k = 0;
            while (side_of(t, k) != s) ++k;
            mesh_.triangles[t][(k + 1) % 3] = middle;
            Triangle other = whole;
            other[k] = middle;
            mesh_.triangles.push_back(other);
            link(t);
            link(mesh_.triangles.size() - 1);
        }
        sides_.erase(s);
    }

    SurfaceMesh& mesh_;
    double edge_;
    StopPoints stops_;
    std::map<Side, std::vector<std::size_t>> sides_;
};

/// Swaps sides between coplanar triangles for the other diagonals of their quadrilaterals where the opposite angles sum to more than half a
/// turn (Lawson 1977). The smallest angle does not decrease.
class Turning {
public:
    explicit Turning(SurfaceMesh& mesh) : mesh_(mesh) {}
    void run() {
        for (std::size_t passes = 0; passes < 100 && turn_sides(); ++passes) {}
    }

private:
    Vec3 at(int corner) const { return mesh_.points[static_cast<std::size_t>(corner)]; }
    double angle_at(int corner, int a, int b) const {
        const Vec3 to_a = at(a) - at(corner), to_b = at(b) - at(corner);
        return std::atan2(to_a.cross(to_b).norm(), to_a.dot(to_b));
    }

    /// Checks each side between two triangles once; each triangle changes at most once.
    bool turn_sides() {
        std::map<std::pair<int, int>, std::vector<std::size_t>> sides;
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                sides[std::minmax(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3])].push_back(t);
        std::vector<char> changed(mesh_.triangles.size(), 0);
        bool any = false;
        for (const auto& [side, on_side] : sides)
            if (on_side.size() == 2 && !changed[on_side[0]] && !changed[on_side[1]] &&
                turn(side.first, side.second, on_side[0], on_side[1])) {
                changed[on_side[0]] = changed[on_side[1]] = 1;
                any = true;
            }
        return any;
    }

    bool turn(int a, int b, std::size_t one, std::size_t other) {
        constexpr double enough = 1e-6;
        const auto across = [&](std::size_t t) {
            return *std::ranges::find_if(mesh_.triangles[t], [&](int corner) { return corner != a && corner != b; });
        };
        const int c = across(one), d = across(other);
        if (angle_at(c, a, b) + angle_at(d, a, b) <= std::numbers::pi + enough || !in_one_plane(mesh_, one, other))
            return false;
        Triangle first{c, a, d}, second{d, b, c};
        if (area_vector(mesh_, first).dot(area_vector(mesh_, mesh_.triangles[one])) < 0) {
            std::swap(first[0], first[2]);
            std::swap(second[0], second[2]);
        }
        mesh_.triangles[one] = first;
        mesh_.triangles[other] = second;
        return true;
    }

    SurfaceMesh& mesh_;
};

double longest_side(const SurfaceMesh& mesh) {
    double longest = 0;
    for (const auto& t : mesh.triangles)
        longest = std::max(longest, longest_side(mesh.points[static_cast<std::size_t>(t[0])],
                                                 mesh.points[static_cast<std::size_t>(t[1])],
                                                 mesh.points[static_cast<std::size_t>(t[2])]));
    return longest;
}

/// Keeps one of triangles with the same corners: faces of two blocks in one place. On a face that is there twice each side would be a border.
void keep_one_of_each(std::vector<Triangle>& triangles) {
    std::set<Triangle> seen;
    std::erase_if(triangles, [&](Triangle t) {
        std::ranges::sort(t);
        return !seen.insert(t).second;
    });
}

} // namespace

SurfaceMesh joined_surface(const std::vector<std::array<Vec3, 3>>& triangles, double tolerance) {
    SurfaceMesh mesh;
    Grid grid(4 * tolerance);
    const Vec3 around = Vec3::Constant(tolerance);
    for (const auto& corners : triangles) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            int same = -1;
            grid.each_in(corners[k] - around, corners[k] + around, [&](int point) {
                const bool near = (mesh.points[static_cast<std::size_t>(point)] - corners[k]).norm() <= tolerance;
                if (near && (same < 0 || point < same)) same = point;
            });
            if (same < 0) {
                same = static_cast<int>(mesh.points.size());
                mesh.points.push_back(corners[k]);
                grid.add(corners[k], same);
            }
            triangle[k] = same;
        }
        const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(triangle[k])]; };
        if (least_height(at(0), at(1), at(2)) > tolerance) mesh.triangles.push_back(triangle);
    }
    keep_one_of_each(mesh.triangles);
    keep_triangles(mesh, std::vector<char>(mesh.triangles.size(), 1));
    return mesh;
}

void cut_at_corners(SurfaceMesh& mesh, double tolerance) {
    double sum = 0;
    for (const auto& t : mesh.triangles)
        sum += longest_side(mesh.points[static_cast<std::size_t>(t[0])], mesh.points[static_cast<std::size_t>(t[1])],
                            mesh.points[static_cast<std::size_t>(t[2])]);
    if (mesh.triangles.empty()) return;
    Grid grid(sum / static_cast<double>(mesh.triangles.size()));
    for (std::size_t k = 0; k < mesh.points.size(); ++k) grid.add(mesh.points[k], static_cast<int>(k));
    const Vec3 around = Vec3::Constant(tolerance);
    std::vector<Triangle> cut;
    for (const auto& t : mesh.triangles) {
        std::vector<int> polygon;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = mesh.points[static_cast<std::size_t>(t[k])],
                       b = mesh.points[static_cast<std::size_t>(t[(k + 1) % 3])];
            const double length = (b - a).norm();
            std::vector<std::pair<double, int>> on_side;
            grid.each_in(a.cwiseMin(b) - around, a.cwiseMax(b) + around, [&](int point) {
                if (std::ranges::find(t, point) != t.end()) return;
                const Vec3 from = mesh.points[static_cast<std::size_t>(point)] - a;
                const double along = from.dot(b - a) / length;
                if (along > tolerance && along < length - tolerance &&
                    (from - along / length * (b - a)).norm() <= tolerance)
                    on_side.emplace_back(along, point);
            });
            std::ranges::sort(on_side);
            polygon.push_back(t[k]);
            for (const auto& [along, point] : on_side)
                if (polygon.back() != point) polygon.push_back(point);
        }
        if (polygon.size() == 3) cut.push_back(t);
        else cut_polygon(mesh.points, std::move(polygon), tolerance, cut);
    }
    mesh.triangles = std::move(cut);
    keep_one_of_each(mesh.triangles);
}

void refine(SurfaceMesh& mesh, double edge) {
    // Halves of narrow triangles are narrow. Diagonals are swapped meanwhile, and swappable ones are halved late, only if necessary: a long
    // strip keeps no points near its border.
    constexpr double diagonal = 1.5;
    Turning(mesh).run();
    for (double most = std::max(edge, 0.5 * longest_side(mesh));; most = std::max(edge, 0.5 * most)) {
        Refinement(mesh, most).halve_borders();
        Turning(mesh).run();
        Refinement(mesh, most > edge ? diagonal * most : edge).run();
        Turning(mesh).run();
        if (most <= edge) break;
    }
    Refinement(mesh, edge).run();
}

void keep_triangles(SurfaceMesh& mesh, const std::vector<char>& kept) {
    std::vector<int> renamed(mesh.points.size(), -1);
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!kept[t]) continue;
        Triangle triangle = mesh.triangles[t];
        for (int& corner : triangle) {
            int& name = renamed[static_cast<std::size_t>(corner)];
            if (name < 0) {
                name = static_cast<int>(points.size());
                points.push_back(mesh.points[static_cast<std::size_t>(corner)]);
            }
            corner = name;
        }
        triangles.push_back(triangle);
    }
    mesh.points = std::move(points);
    mesh.triangles = std::move(triangles);
}

} // namespace kaya
