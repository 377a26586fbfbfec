#include "mechanics/contact/open_corner.hpp"

#include "mechanics/shape/face_corners.hpp"
#include "mechanics/shape/surfaces.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kaya {

namespace {

/// Whether a place is over a face as seen along its normal, away from its edges.
bool is_over(const Model& model, Row face, const Vec3& normal, const Vec3& place) {
    constexpr double clear = 1e-6; // of the edge
    const Span span = model.faces.triangles[face];
    const auto& last = model.triangles.gridpoints[span.end() - 1];
    const auto& x = model.gridpoints.position;
    Vec3 from = x[last[2]];
    return !any_corner(model, face, [&](Row g) {
        const Vec3& to = x[g];
        const Vec3 edge = to - from;
        const bool outside = edge.cross(place - from).dot(normal) < clear * edge.squaredNorm();
        from = to;
        return outside;
    });
}

} // namespace

bool has_open_corner(const Model& model, Row contact) {
    const auto& contacts = model.contacts;
    const Row faces[2] = {contacts.face1[contact], contacts.face2[contact]};
    if (faces[0] == no_row || faces[1] == no_row) return false;
    const Vec3 &n = contacts.normal[contact], &origin = model.blocks.centroid[contacts.block1[contact]];
    const double least = least_closure * contacts.depth[contact];
    for (const int of : {0, 1}) {
        const Row other = faces[1 - of];
        const Vec3 normal = current_normal(model, other);
        const Vec3& base = model.gridpoints.position[model.triangles.gridpoints[model.faces.triangles[other].first][0]];
        const double along = std::abs(normal.dot(n));
        const bool open = any_corner(model, faces[of], [&](Row g) {
            const Vec3& x = model.gridpoints.position[g];
            const double gap = normal.dot(x - base) / along; // the other face looks toward this one
            const double closure = contacts.offset[contact] + contacts.offset_tilt[contact].dot(x - origin) - gap;
            return closure <= least && is_over(model, other, normal, x);
        });
        if (open) return true;
    }
    return false;
}

} // namespace kaya
