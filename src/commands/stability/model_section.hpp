// A vertical section through the model, for limit equilibrium.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"
#include "slopes/section.hpp"

namespace kaya {

/// Position of the section. Distances along it are from the origin of coordinates, heights are against gravity.
struct SectionPlane {
    Vec3 point = Vec3::Zero();
    Vec3 along = Vec3(1, 0, 0), up = Vec3(0, 0, 1); ///< unit, at right angles

    Vec3 normal() const { return along.cross(up); }
    SectionPoint seen(const Vec3& place) const { return {along.dot(place), up.dot(place)}; }
    Vec3 place(const SectionPoint& at) const {
        return point + (at.x() - along.dot(point)) * along + (at.y() - up.dot(point)) * up;
    }
};

/// Visible blocks cut by the plane with their weights and strengths, and the joints between them. Water is that of the model. Throws
/// Diagnostic when a block has no density, or none of them a strength.
SlopeSection section_of(Model& model, JointRegistry& laws, const SectionPlane& plane);

} // namespace kaya
