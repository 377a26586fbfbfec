#include "base/diagnostic.hpp"
#include "geometry/delaunay.hpp"
#include "geometry/mesh.hpp"
#include "geometry/tet_improvement.hpp"

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

/// Shapes with no angle below this are good enough to stop trying; degrees.
constexpr double good_angle = 18;

/// The triangle opposite corner `i`, anticlockwise seen from outside.
constexpr std::array<std::array<int, 3>, 4> outer_triangle{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

std::array<int, 3> triangle_of(const Tet& t, int i) {
    return {t[outer_triangle[i][0]], t[outer_triangle[i][1]], t[outer_triangle[i][2]]};
}

/// The triangles that belong to one tetrahedron only, with the face they lie in; nothing when one lies in
/// no face, which means that rounding has torn the surface.
std::optional<std::vector<TetMesh::BoundaryTriangle>> boundary_of(const MeshPoints& points,
                                                                  const std::vector<Tet>& tetrahedra) {
    std::map<std::array<int, 3>, std::array<int, 3>> open;
    for (const Tet& t : tetrahedra)
        for (int i = 0; i < 4; ++i) {
            const std::array<int, 3> triangle = triangle_of(t, i);
            std::array<int, 3> key = triangle;
            std::sort(key.begin(), key.end());
            const auto [place, fresh] = open.emplace(key, triangle);
            if (!fresh) open.erase(place);
        }
    std::vector<TetMesh::BoundaryTriangle> boundary;
    for (const auto& [key, triangle] : open) {
        const std::vector<int> faces = common_faces(points, {key.begin(), key.end()});
        if (faces.empty()) return std::nullopt;
        boundary.push_back({triangle, faces.front()});
    }
    return boundary;
}

std::optional<TetMesh> try_points(const Polyhedron& polyhedron, MeshPoints points, const ProgressCallback& progress) {
    std::vector<Tet> tetrahedra = delaunay(points.points);
    // Four points of one face make a flat tetrahedron by rounding alone.
    std::erase_if(tetrahedra, [&](const Tet& t) { return !common_faces(points, {t.begin(), t.end()}).empty(); });
    improve(polyhedron, points, tetrahedra, progress);
    auto boundary = boundary_of(points, tetrahedra);
    if (!boundary) return std::nullopt;
    TetMesh mesh{std::move(points.points), std::move(tetrahedra), std::move(*boundary)};
    double volume = 0, wanted = mass_properties(polyhedron).volume;
    for (const Tet& t : mesh.tetrahedra) {
        const Vec3& a = mesh.points[t[0]];
        const double part = (mesh.points[t[1]] - a).dot((mesh.points[t[2]] - a).cross(mesh.points[t[3]] - a)) / 6;
        if (part <= 0) return std::nullopt;
        volume += part;
    }
    if (std::abs(volume - wanted) > 1e-9 * wanted) return std::nullopt;
    return mesh;
}

void check_request(const Polyhedron& polyhedron, double edge) {
    if (!(edge > 0) || !std::isfinite(edge))
        throw Diagnostic(fmt::format("the edge length of zones is {}, and must be above 0", edge));
    // A regular tetrahedron has 0.118 edge^3; half of that or less is common.
    constexpr double most_tetrahedra = 2e8;
    const double expected = mass_properties(polyhedron).volume / (0.1 * edge * edge * edge);
    if (expected > most_tetrahedra)
        throw Diagnostic(fmt::format("an edge length of {} makes some {:.2g} zones in one block", edge, expected),
                         "use longer edges");
}

} // namespace

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

TetMesh make_mesh(const Polyhedron& polyhedron, double edge, const ProgressCallback& progress) {
    check_request(polyhedron, edge);
    std::optional<TetMesh> best;
    double best_angle = -1;
    const auto consider = [&](std::optional<TetMesh>&& candidate) {
        if (!candidate) return;
        const DihedralAngles angles = dihedral_angles(*candidate);
        const double angle = std::min(angles.smallest, 180 - angles.largest);
        if (angle <= best_angle) return;
        best_angle = angle;
        best = std::move(candidate);
    };
    consider(hexahedron_mesh(polyhedron, edge));
    struct Trial {
        double clearance;
        bool centre;
    };
    // How far lattice points keep from the surface decides on the layer next to it; which distance is best
    // depends on how the lattice happens to meet the faces.
    constexpr std::array trials{Trial{0.6, false}, Trial{0.6, true},  Trial{0.5, true},
                                Trial{0.7, true},  Trial{0.45, true}, Trial{0.8, true}};
    for (const Trial& trial : trials)
        if (best_angle < good_angle)
            consider(try_points(polyhedron, place_points(polyhedron, edge, trial.clearance, trial.centre), progress));
    if (!best)
        throw Diagnostic("the block could not be filled with zones",
                         "its faces are not flat or its shape is too thin; look at it with 'list blocks quality'");
    return std::move(*best);
}

} // namespace kaya
