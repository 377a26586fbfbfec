#include "geometry/mesh_points.hpp"

#include "geometry/plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace kaya {
namespace {

/// The two faces next to each edge of the polyhedron, by the edge's lower and higher vertex.
std::map<std::array<int, 2>, std::vector<int>> faces_of_edges(const Polyhedron& polyhedron) {
    std::map<std::array<int, 2>, std::vector<int>> adjacent;
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f) {
        const auto& loop = polyhedron.faces[f].vertices;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const int a = loop[i], b = loop[(i + 1) % loop.size()];
            adjacent[{std::min(a, b), std::max(a, b)}].push_back(static_cast<int>(f));
        }
    }
    return adjacent;
}

void add_edge_points(const Polyhedron& polyhedron, double edge, MeshPoints& result) {
    for (const auto& [ends, faces] : faces_of_edges(polyhedron)) {
        const Vec3 &a = polyhedron.vertices[ends[0]], &b = polyhedron.vertices[ends[1]];
        const int steps = std::max(1, static_cast<int>(std::lround((b - a).norm() / edge)));
        for (int i = 1; i < steps; ++i) result.add(a + (static_cast<double>(i) / steps) * (b - a), faces);
    }
}

/// A lattice of equilateral triangles with rows along the face's longest edge, centred on the face.
void add_face_points(const Polyhedron& polyhedron, int number, double edge, double gap, MeshPoints& result) {
    const auto& face = polyhedron.faces[number];
    const Vec3 normal = face_normal(polyhedron, face);
    Vec3 centre = Vec3::Zero(), along = Vec3::Zero();
    std::vector<Plane> borders; // pointing inward
    for (std::size_t i = 0; i < face.vertices.size(); ++i) {
        const Vec3& a = polyhedron.vertices[face.vertices[i]];
        const Vec3 side = polyhedron.vertices[face.vertices[(i + 1) % face.vertices.size()]] - a;
        centre += a / static_cast<double>(face.vertices.size());
        if (side.norm() > along.norm() * (1 + 1e-9)) along = side;
        borders.push_back({normal.cross(side).normalized(), a});
    }
    double reach = 0;
    for (const int v : face.vertices) reach = std::max(reach, (polyhedron.vertices[v] - centre).norm());
    along.normalize();
    const Vec3 across = normal.cross(along);
    const double row_height = std::sqrt(0.75) * edge;
    const int rows = static_cast<int>(reach / row_height) + 1, columns = static_cast<int>(reach / edge) + 1;
    for (int row = -rows; row <= rows; ++row)
        for (int column = -columns; column <= columns; ++column) {
            const double shift = row % 2 ? 0.5 : 0;
            const Vec3 point = centre + (column + shift) * edge * along + row * row_height * across;
            const bool fits = std::all_of(borders.begin(), borders.end(),
                                          [&](const Plane& border) { return border.distance(point) >= gap; });
            if (fits) result.add(point, {number});
        }
}

/// A body-centred cubic lattice around the centroid.
void add_inner_points(const Polyhedron& polyhedron, const Vec3& centroid, double edge, double gap, MeshPoints& result) {
    // Edges of the lattice's tetrahedra are 1 and sqrt(3)/2 cells long, in the ratio 3 to 4.
    const double cell = edge / ((3 + 4 * std::sqrt(0.75)) / 7);
    std::vector<Plane> walls;
    for (const auto& face : polyhedron.faces)
        walls.push_back({face_normal(polyhedron, face), polyhedron.vertices[face.vertices[0]]});
    std::array<int, 3> low{}, high{};
    for (int k = 0; k < 3; ++k)
        for (const Vec3& v : polyhedron.vertices) {
            low[k] = std::min(low[k], static_cast<int>(std::floor((v[k] - centroid[k]) / cell)));
            high[k] = std::max(high[k], static_cast<int>(std::ceil((v[k] - centroid[k]) / cell)));
        }
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i)
                for (const double half : {0.0, 0.5}) {
                    const Vec3 point = centroid + cell * Vec3(i + half, j + half, k + half);
                    const bool fits = std::all_of(walls.begin(), walls.end(),
                                                  [&](const Plane& wall) { return wall.distance(point) <= -gap; });
                    if (fits) result.add(point, {});
                }
}

} // namespace

std::vector<int> common_faces(const MeshPoints& points, const std::vector<int>& numbers) {
    std::vector<int> common = points.faces[numbers.front()];
    for (const int number : numbers) {
        const auto& faces = points.faces[number];
        std::erase_if(common, [&](int f) { return !std::binary_search(faces.begin(), faces.end(), f); });
    }
    return common;
}

MeshPoints place_points(const Polyhedron& polyhedron, double edge, double clearance, bool centre) {
    MeshPoints result;
    for (const Vec3& v : polyhedron.vertices) result.add(v, {});
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f)
        for (const int v : polyhedron.faces[f].vertices) result.faces[v].push_back(static_cast<int>(f));
    add_edge_points(polyhedron, edge, result);
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f)
        add_face_points(polyhedron, static_cast<int>(f), edge, clearance * edge, result);
    const std::size_t on_surface = result.points.size();
    const Vec3 centroid = mass_properties(polyhedron).centroid;
    add_inner_points(polyhedron, centroid, edge, clearance * edge, result);
    if (centre && result.points.size() == on_surface) result.add(centroid, {});
    return result;
}

} // namespace kaya
