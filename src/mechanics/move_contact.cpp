#include "mechanics/contact_geometry.hpp"
#include "mechanics/phases.hpp"
#include "mechanics/triple.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Cycles between two looks at the faces of deformable blocks, which turn slowly.
constexpr std::int64_t face_interval = 10;

/// Motion of a rigid block seen from a point of its own: velocity there, and spin.
struct RigidMotion {
    Triple velocity, spin;

    RigidMotion(const Blocks& blocks, Row b, const Triple& origin)
        : velocity(blocks.velocity[b]), spin(blocks.rotational_velocity[b]) {
        velocity = velocity + spin.cross(origin - Triple(blocks.centroid[b]));
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
    Triple spin(0, 0, 0);
    if (reference != 0) spin = Triple(blocks.rotational_velocity[owner]);
    else if (!blocks.deformable[b1] && !blocks.deformable[b2])
        spin = 0.5 * (Triple(blocks.rotational_velocity[b1]) + Triple(blocks.rotational_velocity[b2]));
    const Triple before(n), turned = before + (model.clock.time_step * spin).cross(before);
    // It is almost 1 long: one step of Newton's method for 1/sqrt.
    n = ((1.5 - 0.5 * turned.dot(turned)) * turned).vector();
}

inline void add_work(JointWork& work, const SubContacts& subs, Row row, const LaneGroup& group, const Lanes3& shear_force,
              const Lanes& opening, const Lanes3& slip) {
    work.joint += group.load(subs.normal_force.data() + row) * opening + shear_force.dot(slip);
    work.friction += group.load(subs.frictional_work.data() + row);
    work.fluid += group.load(subs.pore_pressure.data() + row) * group.load(subs.area.data() + row) * opening;
}

/// Two rigid blocks: the relative velocity is linear in the place, so that a few numbers per contact
/// serve all its sub-contacts.
void move_between_rigid(Model& model, Row c, JointWork& work) {
    auto& subs = model.sub_contacts;
    auto& contacts = model.contacts;
    const Triple o(contacts.position[c]), normal(contacts.normal[c]);
    const RigidMotion one(model.blocks, contacts.block1[c], o), two(model.blocks, contacts.block2[c], o);
    const double step = model.clock.time_step;
    const bool large = model.settings.large_strain;
    const Triple way = 0.5 * step * (two.velocity + one.velocity), turn = 0.5 * step * (two.spin + one.spin);

    const Lanes3 n = normal.lanes(), origin = o.lanes();
    const Lanes3 apart = (step * (two.velocity - one.velocity)).lanes();
    const Lanes3 apart_turn = (step * (two.spin - one.spin)).lanes();
    const Lanes3 mean = way.lanes(), mean_turn = turn.lanes();
    const Lanes twist = Lanes::Constant(turn.dot(normal));

    const Span span = contacts.sub_contacts[c];
    Lanes farthest = Lanes::Zero();
    JointWork own; // stays in registers, which `work` would not
    for (Row i = span.first; i < span.end(); i += lane_count) {
        const LaneGroup group(span.end() - i);
        const Lanes3 x = group.load(subs.position, i), arm = x - origin;
        const Lanes3 u = apart + apart_turn.cross(arm);
        const Lanes opening = u.dot(n);
        const Lanes3 shear = u - n * opening;
        group.store(subs.normal_displacement_increment.data() + i, opening);
        group.store(subs.shear_displacement_increment, i, shear);
        Lanes3 force = group.load(subs.shear_force, i);
        if (large) {
            farthest = farthest.max(shear.dot(shear));
            group.store(subs.position, i, x + (mean + mean_turn.cross(arm)));
            // The shear force stays in the plane and turns in it with the mean of the blocks.
            const Lanes3 in_plane = force - n * force.dot(n);
            force = in_plane + n.cross(in_plane) * twist;
            group.store(subs.shear_force, i, force);
        }
        add_work(own, subs, i, group, force, opening, shear);
    }
    work.add(own);
    if (!large) return;
    contacts.slid[c] += std::sqrt(farthest.maxCoeff());
    contacts.position[c] += Vec3(way.x, way.y, way.z); // the origin of moments goes with the mean of the blocks
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

void move_between(Model& model, Row c, JointWork& work) {
    auto& contacts = model.contacts;
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
    if (large) contacts.slid[c] += std::sqrt(farthest);
    for (Row row = span.first; row < span.end(); row += lane_count) {
        const LaneGroup group(span.end() - row);
        add_work(work, subs, row, group, group.load(subs.shear_force, row),
                 group.load(subs.normal_displacement_increment.data() + row),
                 group.load(subs.shear_displacement_increment, row));
    }
}

} // namespace

void move_contact(Model& model, Row c, JointWork& work) {
    const auto& contacts = model.contacts;
    if (model.settings.large_strain) turn_plane(model, c);
    if (model.blocks.deformable[contacts.block1[c]] || model.blocks.deformable[contacts.block2[c]])
        move_between(model, c, work);
    else
        move_between_rigid(model, c, work);
}

void turn_kept_vectors(Model& model, Row c, const std::vector<std::size_t>& vectors) {
    if (!model.settings.large_strain) return;
    const auto& contacts = model.contacts;
    const auto& blocks = model.blocks;
    const Row b1 = contacts.block1[c], b2 = contacts.block2[c];
    const Vec3 n = contacts.normal[c];
    const bool rigid = !blocks.deformable[b1] && !blocks.deformable[b2];
    const double twist =
        rigid ? 0.5 * model.clock.time_step * (blocks.rotational_velocity[b1] + blocks.rotational_velocity[b2]).dot(n) : 0;
    const Span span = contacts.sub_contacts[c];
    for (const std::size_t k : vectors) {
        auto* column = &model.sub_contacts.history[k];
        for (Row s = span.first; s < span.end(); ++s) {
            const Vec3 kept(column[0][s], column[1][s], column[2][s]);
            const Vec3 in_plane = kept - kept.dot(n) * n, turned = in_plane + twist * n.cross(in_plane);
            for (int i = 0; i < 3; ++i) column[i][s] = turned[i];
        }
    }
}

} // namespace kaya
