#include "geometry/mesh_points.hpp"

#include "geometry/plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace kaya {

std::vector<int> common_faces(const MeshPoints& points, const std::vector<int>& numbers) {
    std::vector<int> common = points.faces[numbers.front()];
    for (const int number : numbers) {
        const auto& faces = points.faces[number];
        std::erase_if(common, [&](int f) { return !std::binary_search(faces.begin(), faces.end(), f); });
    }
    return common;
}

void add_inner_points(const Polyhedron& polyhedron, double edge, double clearance, bool centre, MeshPoints& points) {
    // Edges of the lattice's tetrahedra are 1 and sqrt(3)/2 cells long, in the ratio 3 to 4.
    // Between the lattice and the faces they are longer; with these cells the mean of all is what is asked for.
    const double cell = 0.93 * edge / ((3 + 4 * std::sqrt(0.75)) / 7), gap = clearance * edge;
    const Vec3 centroid = mass_properties(polyhedron).centroid;
    const std::size_t on_surface = points.points.size();
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
                    if (fits) points.add(point, {});
                }
    if (centre && points.points.size() == on_surface) points.add(centroid, {});
}

} // namespace kaya
