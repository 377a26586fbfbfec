#include "base/diagnostic.hpp"
#include "geometry/mesh/delaunay.hpp"
#include "geometry/mesh/mesh_points.hpp"
#include "geometry/mesh/surface_recovery.hpp"
#include "geometry/mesh/tet_improvement.hpp"
#include "geometry/polyhedra/box_pairs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <optional>

namespace kaya {
namespace {

using Tet = std::array<int, 4>;

/// The triangle opposite corner `i`, anticlockwise seen from outside.
constexpr std::array<std::array<int, 3>, 4> outer_triangle{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

std::array<int, 3> triangle_of(const Tet& t, int i) {
    return {t[outer_triangle[i][0]], t[outer_triangle[i][1]], t[outer_triangle[i][2]]};
}

/// Worse shapes than this get new points, degrees.
constexpr double fair_angle = 15;

/// The least angle between two faces of a block, degrees.
double sharpest_edge(const Polyhedron& p) {
    std::map<std::array<int, 2>, Vec3> normals; // of the face to the left of an edge
    for (const auto& face : p.faces) {
        const Vec3 normal = face_normal(p, face);
        for (std::size_t i = 0; i < face.vertices.size(); ++i)
            normals[{face.vertices[i], face.vertices[(i + 1) % face.vertices.size()]}] = normal;
    }
    double least = std::numbers::pi;
    for (const auto& [edge, normal] : normals) {
        const auto other = normals.find({edge[1], edge[0]});
        if (other == normals.end()) continue;
        least = std::min(least,
                         std::numbers::pi - std::atan2(normal.cross(other->second).norm(), normal.dot(other->second)));
    }
    return least * 180 / std::numbers::pi;
}

/// Replaces the tetrahedra by ones of positive volume; none when some cannot be improved.
std::optional<TetMesh> improved(const Polyhedron& polyhedron, const BlockSurface& surface, MeshPoints points,
                                std::vector<Tet> tetrahedra, bool new_points, const ProgressCallback& progress) {
    improve(points, tetrahedra, new_points, progress);
    const auto& fixed = surface.points.points;
    if (points.points.size() < fixed.size() || !std::equal(fixed.begin(), fixed.end(), points.points.begin()))
        return std::nullopt;
    double volume = 0;
    const double wanted = mass_properties(polyhedron).volume;
    for (const Tet& t : tetrahedra) {
        const Vec3& a = points.points[t[0]];
        const double part = (points.points[t[1]] - a).dot((points.points[t[2]] - a).cross(points.points[t[3]] - a)) / 6;
        if (!(part > 1e-13 * wanted)) return std::nullopt;
        volume += part;
    }
    // The loss of digits at far coordinates shows in the volume.
    double area = 0, far = 0;
    for (const auto& t : surface.triangles) {
        const Vec3& a = points.points[t.points[0]];
        area += (points.points[t.points[1]] - a).cross(points.points[t.points[2]] - a).norm() / 2;
        far = std::max(far, a.lpNorm<Eigen::Infinity>());
    }
    const double noise = 16 * std::numeric_limits<double>::epsilon() * far * area;
    if (std::abs(volume - wanted) > 1e-9 * wanted + noise) return std::nullopt;
    return TetMesh{std::move(points.points), std::move(tetrahedra), surface.triangles};
}

/// The points with faces and edges made slightly convex: no four points are coplanar, so signs need no exact arithmetic, which would
/// dominate the time.
std::vector<Vec3> bulged(const std::vector<Vec3>& points) {
    constexpr double bulge = 1e-5;
    const auto [low, high] = box_around(points);
    const Vec3 centre = 0.5 * (low + high);
    const double factor = bulge / (0.25 * (high - low).squaredNorm());
    std::vector<Vec3> result;
    for (const Vec3& x : points) result.push_back((1 - factor * (x - centre).squaredNorm()) * (x - centre));
    return result;
}

std::optional<TetMesh> try_points(const Polyhedron& polyhedron, const BlockSurface& surface, MeshPoints points,
                                  const ProgressCallback& progress) {
    std::vector<Tet> tetrahedra = delaunay(bulged(points.points));
    // Four points of one face make a flat tetrahedron by rounding alone.
    std::erase_if(tetrahedra, [&](const Tet& t) { return !common_faces(points, {t.begin(), t.end()}).empty(); });
    if (!recover_surface(polyhedron, surface, points, tetrahedra)) return std::nullopt;
    return improved(polyhedron, surface, std::move(points), std::move(tetrahedra), false, progress);
}

/// A tetrahedron from each triangle to the centroid: of bad shape, but always there.
std::optional<TetMesh> star(const Polyhedron& polyhedron, const BlockSurface& surface,
                            const ProgressCallback& progress) {
    MeshPoints points = surface.points;
    const int centre = static_cast<int>(points.points.size());
    points.add(mass_properties(polyhedron).centroid, {});
    std::vector<Tet> tetrahedra;
    for (const auto& t : surface.triangles) tetrahedra.push_back({t.points[0], t.points[2], t.points[1], centre});
    return improved(polyhedron, surface, std::move(points), std::move(tetrahedra), true, progress);
}

} // namespace

void check_mesh_size(const Polyhedron& polyhedron, const EdgeField& field) {
    field.check();
    // A regular tetrahedron has 0.118 edge^3; half of that or less is common.
    constexpr double most_tetrahedra = 2e8;
    const double expected = 10 * field.cubes_in(polyhedron);
    if (expected > most_tetrahedra)
        throw Diagnostic(
            fmt::format("an edge length of {} makes some {:.2g} zones in one block", field.least(), expected),
            "use longer edges");
    // Places on an edge of the block would be too coarse for edges that shrink further.
    constexpr double least_part = 5e-5;
    const Box box = box_around(polyhedron.vertices);
    const double size = (box.high - box.low).norm(), least = field.least_in(box);
    if (!field.even() && least < least_part * size)
        throw Diagnostic(
            fmt::format("edges of {:.3g} are too short for zones that grow in a block of a size of {:.3g}", least,
                        size),
            fmt::format("give edges of {:.2g} or more, or cut the block around the center", least_part * size));
}

double worst_angle(const TetMesh& mesh) {
    const DihedralAngles angles = dihedral_angles(mesh);
    return std::min(angles.smallest, 180 - angles.largest);
}

DihedralAngles dihedral_angles(const TetMesh& mesh) {
    DihedralAngles angles;
    for (const Tet& t : mesh.tetrahedra) {
        std::array<Vec3, 4> normals;
        for (int i = 0; i < 4; ++i) {
            const auto [a, b, c] = triangle_of(t, i);
            normals[i] = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
        }
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j) {
                const double angle = 180 - std::atan2(normals[i].cross(normals[j]).norm(), normals[i].dot(normals[j])) *
                                               180 / std::numbers::pi;
                angles.smallest = std::min(angles.smallest, angle);
                angles.largest = std::max(angles.largest, angle);
            }
    }
    return angles;
}

double fair_angle_of(const Polyhedron& polyhedron) {
    return fair_angle * std::min(1.0, 0.9 * sharpest_edge(polyhedron) / good_angle);
}

TetMesh fill_surface(const Polyhedron& polyhedron, const BlockSurface& surface, const EdgeField& field,
                     const ProgressCallback& progress) {
    std::optional<TetMesh> best;
    double best_angle = -1;
    const auto consider = [&](std::optional<TetMesh>&& candidate) {
        if (!candidate) return;
        const double angle = worst_angle(*candidate);
        if (angle <= best_angle) return;
        best_angle = angle;
        best = std::move(candidate);
    };
    struct Trial {
        double clearance;
        bool centre;
    };
    // The distance of lattice points from the surface decides on the layer next to it; which distance is best depends on how the lattice
    // meets the faces.
    constexpr std::array trials{Trial{0.6, false}, Trial{0.6, true},  Trial{0.5, true},
                                Trial{0.7, true},  Trial{0.45, true}, Trial{0.8, true}};
    // No mesh has larger angles than those between the block's faces.
    const double part = std::min(1.0, 0.9 * sharpest_edge(polyhedron) / good_angle);
    const Spacing spacing = spacing_in(polyhedron, surface, field, Shorter::by_neighbours);
    const bool graded = !field.even() || !spacing.finer.empty();
    std::vector<std::vector<Vec3>> tried;
    for (const Trial& trial : trials) {
        if (best_angle >= good_angle * part) break;
        MeshPoints points = surface.points;
        if (graded) add_graded_points(polyhedron, spacing, trial.clearance, trial.centre, points);
        else add_inner_points(polyhedron, field.edge, trial.clearance, trial.centre, points);
        if (std::ranges::find(tried, points.points) != tried.end()) continue;
        tried.push_back(points.points);
        consider(try_points(polyhedron, surface, std::move(points), progress));
    }
    // New points instead of bad ones.
    const auto with_points = [&](const TetMesh& mesh) {
        MeshPoints points = surface.points;
        for (std::size_t i = points.points.size(); i < mesh.points.size(); ++i) points.add(mesh.points[i], {});
        return improved(polyhedron, surface, std::move(points), mesh.tetrahedra, true, progress);
    };
    if (best && best_angle < fair_angle * part) consider(with_points(*best));
    // Bad regions may still have short edges, where points inside are crowded.
    const Spacing crowded = spacing_in(polyhedron, surface, field, Shorter::at_all);
    for (const double clearance : {0.6, 0.5, 0.7}) {
        if (best_angle >= fair_angle * part || crowded.finer.empty()) break;
        MeshPoints points = surface.points;
        add_graded_points(polyhedron, crowded, clearance, true, points);
        if (std::ranges::find(tried, points.points) != tried.end()) continue;
        tried.push_back(points.points);
        if (const auto other = try_points(polyhedron, surface, std::move(points), progress)) {
            consider(with_points(*other));
            consider(std::optional(*other));
        }
    }
    if (!best) consider(star(polyhedron, surface, progress));
    if (!best)
        throw Diagnostic("the block could not be filled with zones",
                         "its faces are not flat or its shape is too thin; look at it with 'list blocks quality'");
    return std::move(*best);
}

} // namespace kaya
