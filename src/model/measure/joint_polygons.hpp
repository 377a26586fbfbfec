// Joints as surfaces: the common area of two faces.
#pragma once

#include "model/tables/model.hpp"

#include <optional>
#include <vector>

namespace kaya {

/// The gridpoints around a face: the edges that only one of its triangles has, in order. None when they do not make one simple loop.
std::optional<std::vector<Row>> face_outline(const Model& model, Row face);

/// The common area of the two faces of a contact, projected along its normal, as convex polygons on the first face; none for corners and
/// edges.
std::vector<std::vector<Vec3>> joint_polygons(const Model& model, Row contact);
/// The same of any two faces that lie on each other, along a normal.
std::vector<std::vector<Vec3>> common_polygons(const Model& model, Row face1, Row face2, const Vec3& normal);

/// The sub-contact of a contact that is nearest to a place. The contact must have one.
Row nearest_sub_contact(const Model& model, Row contact, const Vec3& place);

} // namespace kaya
