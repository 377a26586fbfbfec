#include "mechanics/contact/curved_closure.hpp"

#include "mechanics/contact/contact_kind.hpp"
#include "mechanics/contact/row_copy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// The force of the halves of an overlap.
struct Pressed {
    double force;
    Vec3 normal, centre;
    double twist;

    Pressed(const OverlapSlopes& slopes, const ClosedHalves& halves, const ClosedHalves::Springs& springs) {
        const OverlapGradient push = halves.push(springs);
        force = push.force.norm();
        normal = push.force / force;
        const Vec3 arm = normal.cross(push.moment) / force, aside = arm - slopes.centroid;
        centre = slopes.origin + arm - aside.dot(normal) * normal;
        twist = push.moment.dot(normal) / force;
    }
};

/// Springs without a stress press as straight ones do.
ClosedHalves::Springs straight_if_open(ClosedHalves::Springs springs, const ClosedHalves& halves) {
    if (springs[0].stress + springs[1].stress > 0) return springs;
    for (int i = 0; i < 2; ++i) {
        const double w = halves.closure(i);
        springs[i] = {w, 1, 0.5 * w * w};
    }
    return springs;
}

/// A normal spring of area 1 at a closure.
struct Spring {
    double stress, stiffness;

    Spring(double stress_, double stiffness_) : stress(stress_), stiffness(stiffness_) {}
    Spring(const SubContacts& subs, Row s)
        : stress(subs.area[s] > 0 ? subs.normal_force[s] / subs.area[s] : 0), stiffness(subs.normal_stiffness[s]) {}
};

/// Work per area from one state to another, `more` closed: the trapezoidal rule with the correction of its ends, within the limits of a
/// stress that grows.
double work_between(const Spring& from, const Spring& to, double more) {
    const double mean = 0.5 * (from.stress + to.stress) - (to.stiffness - from.stiffness) * more / 12;
    return more * std::clamp(mean, std::min(from.stress, to.stress), std::max(from.stress, to.stress));
}

/// The normal spring of a copy of a sub-contact.
class TriedSpring {
public:
    TriedSpring(const Model& model, const JointModel& joint, Row s)
        : joint_(joint),
          values_(model.joint_properties[model.contacts.properties[model.sub_contacts.contact[s]]].values),
          step_(model.clock.time_step) {
        copy_.take(model, joint, s);
    }
    Spring spring() const { return {copy_.normal_force / copy_.area, copy_.normal_stiffness}; }
    Vec3 shear_force() const { return {copy_.shear_force[0], copy_.shear_force[1], copy_.shear_force[2]}; }

    /// Opens it; false when its joint model fails.
    bool open(double by) {
        kaya_jbatch batch = copy_.batch(joint_, values_, step_);
        copy_.normal_disp_inc = by;
        const bool well = !run_batch(joint_, batch);
        copy_.normal_disp += by;
        return well;
    }
    /// The energy per area that it releases while it opens by a closure.
    double returned(double closure) {
        constexpr int steps = 16;
        double energy = 0;
        for (int i = 0; i < steps && copy_.normal_force > 0; ++i) {
            const Spring before = spring();
            if (!open(closure / steps)) break;
            energy += work_between(spring(), before, closure / steps);
        }
        return std::max(0.0, energy);
    }

private:
    const JointModel& joint_;
    const std::vector<double>& values_;
    double step_;
    RowCopy copy_;
};

/// The closure of the spring of a row: its displacement, or that of a straight spring if it is more.
double closure_of(const SubContacts& subs, Row s) {
    const Spring spring(subs, s);
    return std::max(spring.stiffness > 0 ? spring.stress / spring.stiffness : 0, -subs.normal_displacement[s]);
}

/// The springs of the halves as their rows are, with the energies of the contact.
ClosedHalves::Springs springs_of_halves(const Model& model, Row c) {
    const Row first = model.contacts.sub_contacts[c].first;
    const Spring deep(model.sub_contacts, first), shallow(model.sub_contacts, first + 1);
    return {HalfSpring{deep.stress, deep.stiffness, model.contacts.energy_deep[c]},
            HalfSpring{shallow.stress, shallow.stiffness, model.contacts.energy_shallow[c]}};
}

/// Gives the rows of an overlap the force, area and places of its halves; stresses stay.
void put_halves(Model& model, Row c, const OverlapSlopes& slopes, const ClosedHalves& halves) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const ClosedHalves::Springs springs = springs_of_halves(model, c), pressing = straight_if_open(springs, halves);
    const Pressed pressed(slopes, halves, pressing);
    const double area = 2 * pressed.force / (pressing[0].stress + pressing[1].stress);
    const Vec3 shift = pressed.centre - contacts.position[c];
    const Span span = contacts.sub_contacts[c];
    for (Row s = span.first; s < span.first + carriers; ++s) {
        subs.position.set(s, subs.position[s] + shift);
        const double stress = springs[static_cast<std::size_t>(s - span.first) % 2].stress;
        subs.shear_arm.set(s, subs.shear_arm[s] - shift); // its place stays
        subs.area[s] = area / carriers;
        subs.normal_force[s] = stress * subs.area[s];
    }
    contacts.area[c] = area;
    put_open_area(model, c);
    contacts.normal[c] = pressed.normal;
    contacts.position[c] = pressed.centre;
    contacts.twist[c] = pressed.twist;
    const double force = 0.5 * area * (springs[0].stress + springs[1].stress);
    contacts.energy_length[c] = force > 0 ? halves.energy(springs) / force : 0;
}

/// Runs the joint model of the carriers for their normal displacement increments.
void run_carriers(Model& model, const JointModel& joint, Row c) {
    auto& subs = model.sub_contacts;
    const Batch rows{&joint, model.contacts.properties[c], model.contacts.sub_contacts[c].first, carriers, {c}};
    for (Row s = rows.first; s < rows.first + rows.count; ++s) subs.shear_displacement_increment.set(s, Vec3::Zero());
    BatchColumns made;
    auto columns = columns_of(model, rows, model.clock.time_step, made);
    if (const auto failure = run_batch(joint, columns, subs.number.data() + rows.first, Guard::fenced))
        throw joint_failure(model, rows, *failure);
    for (Row s = rows.first; s < rows.first + rows.count; ++s) {
        subs.normal_displacement[s] += subs.normal_displacement_increment[s];
        subs.normal_displacement_increment[s] = 0;
    }
}

/// An overlap that carries a force under a joint model that has become a curved one.
void begin_loaded(Model& model, const JointModel& joint, Row c, OverlapScratch& scratch) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    OverlapSlopes slopes;
    const OverlapPatch patch =
        overlap_patch(model, pair_of(contacts, c), contacts.normal[c], offset_of(contacts, c), scratch, &slopes);
    if (!(patch.carried > 0)) return;
    const ClosedHalves halves(slopes, contacts.whole_area[c]);
    const Row first = contacts.sub_contacts[c].first;
    contacts.depth[c] = slopes.closure.value;
    const double stress =
        CarriedLoad(model, c).force / halves.area() * 2 / (halves.closure(0) + halves.closure(1)); // over the closure
    for (Row s = first; s < first + carriers; ++s) {
        const double closure = halves.closure((s - first) % 2);
        subs.normal_force[s] = stress * closure * subs.area[s];
        subs.normal_displacement[s] = -closure;
    }
    BatchColumns made;
    initialise_rows(model, joint, c, carriers, made);
    contacts.energy_deep[c] = 0.5 * stress * halves.closure(0) * halves.closure(0);
    contacts.energy_shallow[c] = 0.5 * stress * halves.closure(1) * halves.closure(1);
    put_halves(model, c, slopes, halves);
}

/// Growth of a half beyond its closure, as take_dilation has it, in a step.
double dilation_of(const Spring& start, const Spring& end, double more, double closure) {
    constexpr double rounding = 1e-12;
    const double stiffness = 0.5 * (start.stiffness + end.stiffness);
    if (!(start.stress > 0 && end.stress > 0 && stiffness > 0)) return 0;
    const double dilation = (end.stress - start.stress) / stiffness - more;
    return std::abs(dilation) > rounding * closure ? dilation : 0;
}

} // namespace

CarrierRows press(const Model& model, Row c, OverlapPatch& patch, const OverlapSlopes& slopes) {
    const auto& subs = model.sub_contacts;
    const Row first = model.contacts.sub_contacts[c].first;
    const ClosedHalves halves(slopes, model.contacts.whole_area[c]);
    ClosedHalves::Springs springs = springs_of_halves(model, c);
    for (int i = 0; i < 2; ++i) {
        const double more = halves.closure(i) - std::max(0.0, -subs.normal_displacement[first + i]);
        const Spring now(springs[i].stress, springs[i].stiffness),
            then(std::max(0.0, now.stress + now.stiffness * more), now.stiffness);
        const double energy = springs[i].energy + work_between(now, then, more);
        springs[i] = {then.stress, then.stiffness, std::clamp(energy, 0.0, then.stress * halves.closure(i))};
    }
    springs = straight_if_open(springs, halves);
    const Pressed pressed(slopes, halves, springs);
    patch.depth = slopes.closure.value;
    patch.carried = 2 * pressed.force / (springs[0].stress + springs[1].stress) * patch.depth;
    patch.normal = pressed.normal;
    patch.centre = pressed.centre;
    patch.twist = pressed.twist;
    return halves.rows(patch.carrying_area(0));
}

bool holds_when_opened(const Model& model, const JointModel& joint, Row sub_contact, double by) {
    TriedSpring spring(model, joint, sub_contact);
    return model.sub_contacts.area[sub_contact] > 0 && spring.open(by) && spring.spring().stress < 0;
}

void hold_shear(const Model& model, const JointModel& joint, Row c, CarriedLoad& load) {
    const Row first = model.contacts.sub_contacts[c].first;
    for (Row k = 0; k < carriers; ++k) {
        TriedSpring spring(model, joint, first + k);
        if (spring.open(model.sub_contacts.normal_displacement_increment[first + k]))
            load.held[static_cast<std::size_t>(k)] = spring.shear_force();
    }
}

double power_at(const ClosedPlace& place, double stiffness) {
    return place.stress > 0 ? std::clamp(stiffness * place.closure / place.stress, 0.0, 100.0) : 1;
}

void settle_curved(Model& model, Row c, const OverlapSlopes& slopes, const CarriedLoad& before, bool slips) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Row first = contacts.sub_contacts[c].first;
    const double area = contacts.area[c] / carriers;
    const ClosedHalves halves(slopes, contacts.whole_area[c]);
    const std::array<double*, 2> energies{&contacts.energy_deep[c], &contacts.energy_shallow[c]};
    double grown = 0, stiffness = 0;
    for (int i = 0; i < 2; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double closure = halves.closure(i), more = closure - std::max(0.0, -subs.normal_displacement[first + i]);
        const Spring start(before.normal[k] / area, before.normal_stiffness[k]), end(subs, first + i);
        // A joint that does not slip does not dilate, however well its model knows its stiffness.
        const double dilation = slips ? dilation_of(start, end, more, closure) : 0;
        *energies[k] = std::clamp(*energies[k] + work_between(start, end, more + dilation), 0.0,
                                  std::max(0.0, end.stress * closure));
        for (const Row s : {first + i, first + i + 2}) subs.normal_displacement[s] -= dilation;
        grown += dilation * end.stiffness;
        stiffness += end.stiffness;
    }
    put_halves(model, c, slopes, halves);
    if (grown == 0) return;
    contacts.offset[c] += grown / stiffness;
    contacts.energy_taken[c] += CarriedLoad(model, c).force * grown / stiffness;
}

void begin_curved(Model& model, const JointModel& joint, Row c, const OverlapSlopes& slopes, const ClosedPlace& from) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const ClosedHalves halves(slopes, contacts.whole_area[c]);
    const Row first = contacts.sub_contacts[c].first;
    // Shear is shared as the normal force will be: friction would take it from the shallower half.
    const double power = power_at(from, subs.normal_stiffness[first]),
                 less = std::pow(halves.closure(1) / halves.closure(0), power);
    for (Row s = first; s < first + carriers; ++s) {
        const double share = ((s - first) % 2 == 0 ? 1 : less) * 2 / (1 + less);
        subs.shear_force.set(s, share * Vec3(subs.shear_force[s]));
        subs.normal_force[s] = from.stress * subs.area[s];
        subs.normal_displacement[s] = -from.closure;
    }
    close_halves(model, joint, c, slopes);
}

void close_halves(Model& model, const JointModel& joint, Row c, const OverlapSlopes& slopes) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const ClosedHalves halves(slopes, contacts.whole_area[c]);
    const Row first = contacts.sub_contacts[c].first;
    for (Row s = first; s < first + carriers; ++s)
        subs.normal_displacement_increment[s] = -subs.normal_displacement[s] - halves.closure((s - first) % 2);
    run_carriers(model, joint, c);
    contacts.depth[c] = slopes.closure.value;
    contacts.energy_deep[c] = TriedSpring(model, joint, first).returned(halves.closure(0));
    contacts.energy_shallow[c] = TriedSpring(model, joint, first + 1).returned(halves.closure(1));
    put_halves(model, c, slopes, halves);
    contacts.energy_taken[c] = ContactLoad(model, c).normal * contacts.energy_length[c];
}

void note_curved(Model& model, const std::vector<Batch>& batches) {
    auto& contacts = model.contacts;
    OverlapScratch scratch;
    for (const Batch& batch : batches)
        for (const Row c : batch.contacts) {
            const bool carries = follows_overlap(model, c) && contacts.depth[c] > 0;
            if (batch.curved && contacts.curved[c] == 0) {
                contacts.curved[c] = 1;
                if (carries) begin_loaded(model, *batch.model, c, scratch);
            }
            if (!batch.curved && !carries) contacts.curved[c] = 0;
        }
}

bool closes_alike(const Model& model, const JointModel& joint, Row c, std::span<const PlaceAhead> places) {
    // A rocking block opens and closes its joint twice in a period. Where the area of the joint is not known, the halves are those of a strip,
    // which has more energy than the joint.
    constexpr double same = 0.02, made = 2e-3, of_strip = 0.4;
    const auto& contacts = model.contacts;
    const auto& subs = model.sub_contacts;
    const Row first = contacts.sub_contacts[c].first;
    const Spring deep(subs, first), shallow(subs, first + 1);
    const double withheld = std::min(0.5, contacts.withheld[c]), mean = contacts.depth[c],
                 base = -subs.normal_displacement[first],
                 force = 0.5 * contacts.area[c] * (deep.stress + shallow.stress) / (1 - withheld),
                 energy = force * contacts.energy_length[c],
                 energies = contacts.energy_deep[c] + contacts.energy_shallow[c];
    if (!(energies > 0 && mean > 0)) return false;
    const double area = energy / energies * (base - subs.normal_displacement[first + 1]) / mean,
                 less = contacts.whole_area[c] > 0 ? same : of_strip;
    double volume = 0, square = 0, joint_force = 0, joint_energy = 0;
    for (const PlaceAhead& p : places) volume += p.area * p.closure, square += p.area * p.closure * p.closure;
    if (std::abs(volume - area * mean) > same * volume || std::abs(square - area * mean * mean) > 2 * same * square)
        return false;
    for (const PlaceAhead& p : places) {
        TriedSpring spring(model, joint, first);
        if (!spring.open(base - p.closure)) return false;
        joint_force += p.area * spring.spring().stress;
    }
    if (joint_force - force > same * force || force - joint_force > less * force) return false;
    for (const PlaceAhead& p : places) {
        TriedSpring spring(model, joint, first);
        spring.open(base - p.closure);
        joint_energy += p.area * spring.returned(p.closure);
    }
    return joint_energy - energy <= made * energy && energy - joint_energy <= 2 * less * energy;
}

double energy_of_rows(const Model& model, const JointModel& joint, Row c) {
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    double energy = 0;
    for (Row s = span.first; s < span.end(); ++s)
        if (subs.area[s] > 0 && subs.normal_force[s] > 0)
            energy += subs.area[s] * TriedSpring(model, joint, s).returned(closure_of(subs, s));
    return energy;
}

} // namespace kaya
