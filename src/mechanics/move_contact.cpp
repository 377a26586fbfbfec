#include "mechanics/contact_geometry.hpp"
#include "mechanics/phases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Cycles between two looks at the faces of deformable blocks, which turn slowly.
constexpr std::int64_t face_interval = 10;

/// Motion of a rigid block seen from a point of its own: velocity there, and spin.
struct RigidMotion {
    Vec3 velocity, spin;

    RigidMotion(const Blocks& blocks, Row b, const Vec3& origin)
        : velocity(blocks.velocity[b]), spin(blocks.rotational_velocity[b]) {
        velocity += spin.cross(origin - blocks.centroid[b]);
    }
};

/// The plane turns with the block whose face it is.
void turn_plane(Model& model, Row c) {
    auto& contacts = model.contacts;
    const auto& blocks = model.blocks;
    const std::int32_t reference = contacts.reference[c];
    const Row b1 = contacts.block1[c], b2 = contacts.block2[c];
    const Row owner = reference == 1 ? b1 : b2;
    Vec3& n = contacts.normal[c];
    if (reference != 0 && blocks.deformable[owner]) {
        if (model.clock.cycle % face_interval != 0) return;
        const Vec3 outward = current_normal(model, reference == 1 ? contacts.face1[c] : contacts.face2[c]);
        if (!outward.isZero()) n = reference == 1 ? outward : Vec3(-outward);
        return;
    }
    Vec3 spin = Vec3::Zero();
    if (reference != 0) spin = blocks.rotational_velocity[owner];
    else if (!blocks.deformable[b1] && !blocks.deformable[b2])
        spin = 0.5 * (blocks.rotational_velocity[b1] + blocks.rotational_velocity[b2]);
    if (spin.isZero(0)) return;
    n += model.clock.time_step * spin.cross(n);
    n.normalize();
}

/// Two rigid blocks: the relative velocity is linear in the place, so that a few numbers per contact
/// serve all its sub-contacts. Written over columns for the compiler's vector instructions.
double move_between_rigid(Model& model, Row c) {
    auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    const Vec3 o = contacts.position[c], n = contacts.normal[c];
    const RigidMotion one(model.blocks, contacts.block1[c], o), two(model.blocks, contacts.block2[c], o);
    const double step = model.clock.time_step;
    const bool large = model.settings.large_strain;
    const Vec3 a = step * (two.velocity - one.velocity), b = step * (two.spin - one.spin);
    const Vec3 m = 0.5 * step * (two.velocity + one.velocity), h = 0.5 * step * (two.spin + one.spin);
    const double twist = large ? h.dot(n) : 0;

    const Span span = contacts.sub_contacts[c];
    double* __restrict x = subs.position.component[0].data() + span.first;
    double* __restrict y = subs.position.component[1].data() + span.first;
    double* __restrict z = subs.position.component[2].data() + span.first;
    double* __restrict un = subs.normal_displacement_increment.data() + span.first;
    double* __restrict ux = subs.shear_displacement_increment.component[0].data() + span.first;
    double* __restrict uy = subs.shear_displacement_increment.component[1].data() + span.first;
    double* __restrict uz = subs.shear_displacement_increment.component[2].data() + span.first;
    double* __restrict fx = subs.shear_force.component[0].data() + span.first;
    double* __restrict fy = subs.shear_force.component[1].data() + span.first;
    double* __restrict fz = subs.shear_force.component[2].data() + span.first;
    double farthest = 0;
    const double moves = large ? 1 : 0;
    for (Row i = 0; i < span.count; ++i) {
        const double rx = x[i] - o.x(), ry = y[i] - o.y(), rz = z[i] - o.z();
        const double dx = a.x() + b.y() * rz - b.z() * ry;
        const double dy = a.y() + b.z() * rx - b.x() * rz;
        const double dz = a.z() + b.x() * ry - b.y() * rx;
        const double opening = dx * n.x() + dy * n.y() + dz * n.z();
        const double sx = dx - opening * n.x(), sy = dy - opening * n.y(), sz = dz - opening * n.z();
        un[i] = opening;
        ux[i] = sx;
        uy[i] = sy;
        uz[i] = sz;
        const double s2 = sx * sx + sy * sy + sz * sz;
        farthest = s2 > farthest ? s2 : farthest;
        x[i] += moves * (m.x() + h.y() * rz - h.z() * ry);
        y[i] += moves * (m.y() + h.z() * rx - h.x() * rz);
        z[i] += moves * (m.z() + h.x() * ry - h.y() * rx);
        const double out = fx[i] * n.x() + fy[i] * n.y() + fz[i] * n.z();
        const double px = fx[i] - out * n.x(), py = fy[i] - out * n.y(), pz = fz[i] - out * n.z();
        fx[i] = px + twist * (n.y() * pz - n.z() * py);
        fy[i] = py + twist * (n.z() * px - n.x() * pz);
        fz[i] = pz + twist * (n.x() * py - n.y() * px);
    }
    return farthest;
}

/// Velocity of the material point of one side.
struct SideMotion {
    const Model& model;
    bool deformable;
    Vec3 velocity, spin, centre; ///< of a rigid block

    SideMotion(const Model& m, Row block) : model(m), deformable(m.blocks.deformable[block] != 0) {
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

double move_between(Model& model, Row c) {
    const auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const SideMotion side1(model, contacts.block1[c]), side2(model, contacts.block2[c]);
    const Vec3 n = contacts.normal[c];
    const double step = model.clock.time_step;
    const bool large = model.settings.large_strain;
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
        const Vec3 force = subs.shear_force[s];
        subs.shear_force.set(s, force - force.dot(n) * n);
    }
    return farthest;
}

} // namespace

void move_contact(Model& model, Row c) {
    auto& contacts = model.contacts;
    const bool large = model.settings.large_strain;
    if (large) turn_plane(model, c);
    const bool rigid = !model.blocks.deformable[contacts.block1[c]] && !model.blocks.deformable[contacts.block2[c]];
    const double farthest = rigid ? move_between_rigid(model, c) : move_between(model, c);
    if (large) {
        contacts.slid[c] += std::sqrt(farthest);
        if (rigid) {
            // The origin of moments goes with the mean of the blocks.
            const RigidMotion one(model.blocks, contacts.block1[c], contacts.position[c]),
                two(model.blocks, contacts.block2[c], contacts.position[c]);
            contacts.position[c] += 0.5 * model.clock.time_step * (one.velocity + two.velocity);
        }
    }
}

} // namespace kaya
