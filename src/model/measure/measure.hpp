// Present sizes and positions of faces and zones, from the positions of their gridpoints.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Half the cross product of two edges: its length is the area, its direction outward.
Vec3 triangle_area_vector(const Vec3& a, const Vec3& b, const Vec3& c);
Vec3 triangle_area_vector(const Model& model, Row triangle);
/// The weights of the corners of a triangle that interpolate at a place, or at its projection; they sum to 1, and some are below 0 outside of it.
Vec3 weights_in_triangle(const std::array<Vec3, 3>& corners, const Vec3& place);
Vec3 triangle_centroid(const Model& model, Row triangle);

/// Sum over the face's triangles.
Vec3 face_area_vector(const Model& model, Row face);
/// Mean of the triangles' centroids, weighted with their areas.
Vec3 face_centroid(const Model& model, Row face);

/// All gridpoints on it, each once; of a rigid block its corners.
std::vector<Row> face_gridpoints(const Model& model, Row face);

double zone_volume(const Model& model, Row zone);
Vec3 zone_centroid(const Model& model, Row zone);

/// Principal stresses of a zone, the most compressive (most negative) first.
Vec3 principal_stresses(const Model& model, Row zone);
/// The same with their directions: unit vectors, the columns.
std::pair<Vec3, Mat3> principal_axes(const Model& model, Row zone);

/// The column for a gridpoint of a deformable block; the velocity of the block for a vertex of a rigid one.
Vec3 gridpoint_velocity(const Model& model, Row gridpoint);

/// The column for a rigid block; the present centroid of the zones for a deformable one.
Vec3 block_centroid(const Model& model, Row block);

/// The column for a rigid block; the mean over gridpoints by mass for a deformable one (equal weights while masses are unknown).
Vec3 block_velocity(const Model& model, Row block);
Vec3 block_displacement(const Model& model, Row block);

/// The column of a rigid block; for a deformable one the sum over its gridpoints.
Vec3 block_force(const Model& model, Row block);
Vec3 block_load(const Model& model, Row block);

/// All forces on a block, or on a gridpoint of a deformable one, with its loads and its weight.
Vec3 unbalanced_force(const Model& model, Row block);
Vec3 unbalanced_at_gridpoint(const Model& model, Row gridpoint);

} // namespace kaya
