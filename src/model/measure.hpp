// Sizes and places of faces and zones as they are now, from the positions of their gridpoints.
#pragma once

#include "model/model.hpp"

namespace kaya {

/// Half the cross product of two edges: its length is the area, its direction outward.
Vec3 triangle_area_vector(const Model& model, Row triangle);
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

/// Of a deformable block's gridpoint its column; the vertex of a rigid block goes with the block.
Vec3 gridpoint_velocity(const Model& model, Row gridpoint);

/// Of a rigid block its column; of a deformable one that of its zones as they are now.
Vec3 block_centroid(const Model& model, Row block);

/// Of a rigid block its column; of a deformable one the mean of its gridpoints, weighted with their
/// masses (equally while these are not known).
Vec3 block_velocity(const Model& model, Row block);
Vec3 block_displacement(const Model& model, Row block);

/// Of a rigid block its column; of a deformable one the sum over its gridpoints.
Vec3 block_force(const Model& model, Row block);
Vec3 block_load(const Model& model, Row block);

} // namespace kaya
