#include "base/parallel.hpp"
#include "mechanics/contact_geometry.hpp"
#include "mechanics/phases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 64;
/// Cycles between two looks at the faces of deformable blocks, which turn slowly.
constexpr std::int64_t face_interval = 10;

/// Velocity of the material point of one side.
struct SideMotion {
    const Model& model;
    bool deformable;
    Vec3 velocity, spin, centre; ///< of a rigid block

    SideMotion(const Model& m, Row block) : model(m), deformable(m.blocks.deformable[block] != 0) {
        if (deformable) return;
        velocity = m.blocks.velocity[block];
        spin = m.blocks.rotational_velocity[block];
        centre = m.blocks.centroid[block];
    }
    Vec3 at(const Attachment& side, const Vec3& place) const {
        if (!deformable) return velocity + spin.cross(place - centre);
        const auto& v = model.gridpoints.velocity;
        if (side.weights[0] == 1) return v[side.gridpoints[0]];
        return side.weights[0] * v[side.gridpoints[0]] + side.weights[1] * v[side.gridpoints[1]] +
               side.weights[2] * v[side.gridpoints[2]];
    }
};

/// The plane turns with the block whose face it is.
void turn_plane(Model& model, std::size_t c, const SideMotion& side1, const SideMotion& side2) {
    auto& contacts = model.contacts;
    Vec3& n = contacts.normal[c];
    const std::int32_t reference = contacts.reference[c];
    const SideMotion& owner = reference == 1 ? side1 : side2;
    if (reference != 0 && owner.deformable) {
        if (model.clock.cycle % face_interval != 0) return;
        const Vec3 outward = current_normal(model, reference == 1 ? contacts.face1[c] : contacts.face2[c]);
        if (!outward.isZero()) n = reference == 1 ? outward : Vec3(-outward);
        return;
    }
    Vec3 spin = Vec3::Zero();
    if (reference != 0) spin = owner.spin;
    else if (!side1.deformable && !side2.deformable) spin = 0.5 * (side1.spin + side2.spin);
    if (spin.isZero(0)) return;
    n += model.clock.time_step * spin.cross(n);
    n.normalize();
}

} // namespace

void update_contacts(Model& model) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const double step = model.clock.time_step;
    const bool large = model.settings.large_strain;
    for_chunks(contacts.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c) {
            const SideMotion side1(model, contacts.block1[c]), side2(model, contacts.block2[c]);
            if (large) turn_plane(model, c, side1, side2);
            const Vec3 n = contacts.normal[c];
            double twist = 0;
            if (large && !side1.deformable && !side2.deformable)
                twist = 0.5 * step * (side1.spin + side2.spin).dot(n);

            double farthest = 0;
            const Span span = contacts.sub_contacts[c];
            for (Row s = span.first; s < span.end(); ++s) {
                const Vec3 place = subs.position[s];
                const Vec3 v1 = side1.at(subs.side1[s], place), v2 = side2.at(subs.side2[s], place);
                const Vec3 increment = (v2 - v1) * step;
                const double opening = increment.dot(n);
                const Vec3 shear = increment - opening * n;
                subs.normal_displacement_increment[s] = opening;
                subs.shear_displacement_increment.set(s, shear);
                farthest = std::max(farthest, shear.squaredNorm());
                if (!large) continue;
                subs.position.set(s, place + 0.5 * step * (v1 + v2));
                Vec3 force = subs.shear_force[s];
                force -= force.dot(n) * n;
                if (twist != 0) force += twist * n.cross(force);
                subs.shear_force.set(s, force);
            }
            if (large) contacts.slid[c] += std::sqrt(farthest);
        }
    });
}

} // namespace kaya
