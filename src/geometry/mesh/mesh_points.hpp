// The surface of a block as triangles, and the points inside of it that tetrahedra are made of. Private to geometry.
#pragma once

#include "geometry/mesh/edge_field.hpp"
#include "geometry/mesh/mesh.hpp"
#include "geometry/mesh/graded_points.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

#include <vector>

namespace kaya {

struct MeshPoints {
    std::vector<Vec3> points;            ///< the polyhedron's vertices come first, unchanged
    std::vector<std::vector<int>> faces; ///< of the polyhedron that contain each point, ascending

    void add(const Vec3& point, std::vector<int> on_faces) {
        points.push_back(point);
        faces.push_back(std::move(on_faces));
    }
};

/// Faces that contain all the points.
std::vector<int> common_faces(const MeshPoints& points, const std::vector<int>& numbers);

/// The prescribed triangles of a block's faces, whatever tetrahedra fill it.
struct BlockSurface {
    MeshPoints points;
    std::vector<TetMesh::BoundaryTriangle> triangles;
};

/// The side of the cells of a body-centred cubic lattice that makes tetrahedra with edges of that length.
double lattice_cell(double edge);

/// Points `edge` apart inside: a body-centred cubic lattice with a distance of `clearance` times `edge` from the faces. If none fits, the
/// centroid is added if `centre` is true.
void add_inner_points(const Polyhedron& polyhedron, double edge, double clearance, bool centre, MeshPoints& points);

/// The same with edges that vary, and with room between coarse and fine.
void add_graded_points(const Polyhedron& polyhedron, const Spacing& spacing, double clearance, bool centre,
                       MeshPoints& points);

/// Edges of the field's length, growing from shorter ones of the surface: shorter than its own corners require, or any.
enum class Shorter { by_neighbours, at_all };
Spacing spacing_in(const Polyhedron& polyhedron, const BlockSurface& surface, const EdgeField& field, Shorter shorter);

/// The least angle between faces of tetrahedra, or 180 degrees minus the largest.
double worst_angle(const TetMesh& mesh);

/// The worst angle of a block's mesh below which improvement is worthwhile. No mesh has larger angles than those between the block's faces.
double fair_angle_of(const Polyhedron& polyhedron);

/// Throws Diagnostic when the edge is not above 0 or there would be more tetrahedra than any machine can hold.
void check_mesh_size(const Polyhedron& polyhedron, const EdgeField& field);

/// Tetrahedra in the block whose outer triangles are those of the surface. Throws Diagnostic when none can be made.
TetMesh fill_surface(const Polyhedron& polyhedron, const BlockSurface& surface, const EdgeField& field,
                     const ProgressCallback& progress = {});

} // namespace kaya
