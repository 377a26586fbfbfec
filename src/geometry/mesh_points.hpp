// Where the points of a mesh lie: corners, edges, faces and the inside of a polyhedron. Private to geometry.
#pragma once

#include "geometry/polyhedron.hpp"

#include <vector>

namespace kaya {

struct MeshPoints {
    std::vector<Vec3> points;            ///< the polyhedron's vertices come first, unchanged
    std::vector<std::vector<int>> faces; ///< of the polyhedron that each point lies on, rising

    void add(const Vec3& point, std::vector<int> on_faces) {
        points.push_back(point);
        faces.push_back(std::move(on_faces));
    }
};

/// Faces that all the points lie on.
std::vector<int> common_faces(const MeshPoints& points, const std::vector<int>& numbers);

/// Points `edge` apart: even steps along the edges, a lattice of equilateral triangles in the faces,
/// a body-centred cubic lattice inside. Lattice points keep `clearance` times `edge` away from what bounds
/// them. When none fits inside, the centroid is taken if `centre` is true.
MeshPoints place_points(const Polyhedron& polyhedron, double edge, double clearance, bool centre);

} // namespace kaya
