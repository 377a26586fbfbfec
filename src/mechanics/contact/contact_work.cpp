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

/// Calls visit(row, relative velocity) for the sub-contacts of a contact with zones.
template <class Visit> void each_speed_of_zones(const Model& model, Row c, const Visit& visit) {
    const auto& subs = model.sub_contacts;
    const SideMotion one(model, model.contacts.block1[c]), two(model, model.contacts.block2[c]);
    const Span span = model.contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); ++s) {
        const Vec3 place = subs.position[s];
        visit(s, two.at(subs.side2[s], place) - one.at(subs.side1[s], place));
    }
}

double work_of_zones(const Model& model, Row c) {
    const auto& subs = model.sub_contacts;
    const Vec3 n = model.contacts.normal[c];
    double power = 0;
    each_speed_of_zones(model, c, [&](Row s, const Vec3& speed) {
        power += (subs.normal_force[s] * n + Vec3(subs.shear_force[s])).dot(speed);
    });
    return power * model.clock.time_step;
}

/// Opening of the sub-contacts of a contact in the step, by pressure times area.
double fluid_work_of(const Model& model, Row c, StepPlaces places) {
    const auto& subs = model.sub_contacts;
    const Vec3 n = model.contacts.normal[c];
    double work = 0;
    const auto add = [&](Row s, const Vec3& motion) {
        work += subs.pore_pressure[s] * wet_area(model, c, s) * n.dot(motion);
    };
    if (between_rigid(model, c)) {
        const RelativeMotion motion(model, c);
        const bool moved = places == StepPlaces::start && model.settings.large_strain;
        const RelativeMotion acts = moved ? motion.at_start() : motion;
        const Span span = model.contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s) add(s, acts.at(Vec3(subs.position[s])));
    } else {
        each_speed_of_zones(model, c, [&](Row s, const Vec3& speed) { add(s, Vec3(model.clock.time_step * speed)); });
    }
    return work;
}

} // namespace

double work_of_step(const Model& model, Row c) {
    if (!between_rigid(model, c)) return work_of_zones(model, c);
    JointWork work;
    add_work_of(model, c, RelativeMotion(model, c), work);
    return sum(work.joint);
}

double fluid_work(const Model& model, StepPlaces places) {
    constexpr std::size_t grain = 256;
    return reduce_chunks(
        model.contacts.size(), grain, 0.0,
        [&](std::size_t first, std::size_t last) {
            double work = 0;
            for (std::size_t i = first; i < last; ++i) work += fluid_work_of(model, static_cast<Row>(i), places);
            return work;
        },
        [](double& sum, double part) { sum += part; });
}

} // namespace kaya
