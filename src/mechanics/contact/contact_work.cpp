#include "mechanics/contact/contact_work.hpp"
#include "base/reduce.hpp"
#include "mechanics/shape/overlap_patch.hpp"

#include "model/measure/rayleigh.hpp"

#include <Eigen/Geometry>
#include <numeric>

namespace kaya {

void add_work_of(const Model& model, Row c, const RelativeMotion& motion, JointWork& work) {
    const auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    const Vec3 turn = motion.two.turn - motion.one.turn;
    const Eight3 n = eights(contacts.normal[c]), origin = eights(contacts.position[c]),
                 apart = eights(motion.at(contacts.position[c])), apart_turn = eights(turn);
    const bool damped = joints_are_damped(model.settings);
    const Span span = contacts.sub_contacts[c];
    JointWork own; // stays in registers
    Eight of_dashpots{}, normal{};
    for (Row i = span.first; i < span.end(); i += eight) {
        const RowsOfEight group(span.end() - i);
        const Eight3 shift = apart + apart_turn.cross(group.load(subs.position, i, origin) - origin);
        const Eight force = group.load(subs.normal_force.data() + i);
        normal += force;
        Eight3 aside = shift;
        if (i == span.first) aside = shift + apart_turn.cross(group.load(subs.shear_arm, i)); // only carriers have one
        own.joint += force * n.dot(shift) + group.load(subs.shear_force, i).dot(aside);
        own.friction += group.load(subs.frictional_work.data() + i);
        own.fluid += group.load(subs.pore_pressure.data() + i) * group.load(subs.area.data() + i) * n.dot(shift);
        if (damped)
            of_dashpots += group.load(subs.dashpot_normal.data() + i) * n.dot(shift) +
                           group.load(subs.dashpot_shear, i).dot(aside);
    }
    if (contacts.twist[c] != 0) own.joint[0] += sum(normal) * contacts.twist[c] * contacts.normal[c].dot(turn);
    own.dashpots = damped ? sum(of_dashpots) : 0;
    work.add(own);
}

double frictional_work(const Model& model, Row c) {
    const Span span = model.contacts.sub_contacts[c];
    const double* const work = model.sub_contacts.frictional_work.data();
    return std::accumulate(work + span.first, work + span.end(), 0.0);
}

namespace {

/// Of the forces and of the pore pressure of a contact with zones.
struct ZoneContactWork {
    double force = 0, fluid = 0;

    ZoneContactWork(const Model& model, Row c) {
        const auto& subs = model.sub_contacts;
        const auto& contacts = model.contacts;
        const SideMotion one(model, contacts.block1[c]), two(model, contacts.block2[c]);
        const Vec3 n = contacts.normal[c];
        const Span span = contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s) {
            const Vec3 place = subs.position[s];
            const Vec3 speed = two.at(subs.side2[s], place) - one.at(subs.side1[s], place);
            force += (subs.normal_force[s] * n + Vec3(subs.shear_force[s])).dot(speed);
            fluid += subs.pore_pressure[s] * subs.area[s] * n.dot(speed);
        }
        force *= model.clock.time_step;
        fluid *= model.clock.time_step;
    }
};

JointWork work_of_rigid(const Model& model, Row c) {
    JointWork work;
    add_work_of(model, c, RelativeMotion(model, c), work);
    return work;
}

} // namespace

double work_of_step(const Model& model, Row c) {
    return between_rigid(model, c) ? sum(work_of_rigid(model, c).joint) : ZoneContactWork(model, c).force;
}

double fluid_work(const Model& model, Row c) {
    return between_rigid(model, c) ? sum(work_of_rigid(model, c).fluid) : ZoneContactWork(model, c).fluid;
}

double fluid_work(const Model& model) {
    if (model.settings.water == Water::none) return 0;
    constexpr std::size_t grain = 256;
    return reduce_chunks(
        model.contacts.size(), grain, 0.0,
        [&](std::size_t first, std::size_t last) {
            double work = 0;
            for (std::size_t i = first; i < last; ++i) work += fluid_work(model, static_cast<Row>(i));
            return work;
        },
        [](double& sum, double part) { sum += part; });
}

} // namespace kaya
