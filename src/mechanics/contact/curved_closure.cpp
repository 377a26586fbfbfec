#include "mechanics/contact/curved_closure.hpp"

#include "mechanics/contact/contact_kind.hpp"
#include "mechanics/contact/row_copy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// The normal force of an overlap over the stress, as a vector with its line of action.
struct Pressed {
    double area;
    Vec3 normal, centre;
    double twist;

    /// Equation (10d) over the stress.
    Pressed(const OverlapSlopes& slopes, double part) {
        const double closure = slopes.closure.value, whole = 2 * slopes.energy.value / (closure * closure);
        OverlapGradient push;
        push.add(slopes.energy, 2 * part / closure);
        push.add(slopes.closure, whole * (1 - 2 * part));
        area = push.force.norm();
        normal = push.force / area;
        const Vec3 arm = normal.cross(push.moment) / area, aside = arm - slopes.centroid;
        centre = slopes.origin + arm - aside.dot(normal) * normal;
        twist = push.moment.dot(normal) / area;
    }
};

double part_of(double energy_density, double stress, double closure) {
    const double greatest = stress * closure;
    return greatest > 0 ? std::clamp(energy_density / greatest, 0.0, 1.0) : 0.5;
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

    /// Opens it; false when its joint model fails.
    bool open(double by) {
        kaya_jbatch batch = copy_.batch(joint_, values_, step_);
        copy_.normal_disp_inc = by;
        const bool well = !run_batch(joint_, batch);
        copy_.normal_disp += by;
        return well;
    }
    /// What it returns per area when it opens by a closure.
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

/// Gives the rows of an overlap the force, area and places of a part; the stress stays.
void put_part(Model& model, Row c, const OverlapSlopes& slopes, double part) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const Pressed pressed(slopes, part);
    const Vec3 shift = pressed.centre - contacts.position[c];
    const Span span = contacts.sub_contacts[c];
    double force = 0;
    for (Row s = span.first; s < span.end(); ++s) {
        subs.position.set(s, Vec3(subs.position[s]) + shift);
        if (s >= span.first + carriers) continue;
        const double area = pressed.area / carriers;
        subs.normal_force[s] = subs.area[s] > 0 ? subs.normal_force[s] * (area / subs.area[s]) : 0;
        subs.area[s] = area;
        force += subs.normal_force[s];
    }
    contacts.area[c] = pressed.area;
    contacts.normal[c] = pressed.normal;
    contacts.position[c] = pressed.centre;
    contacts.twist[c] = pressed.twist;
    const double closure = slopes.closure.value,
                 energy = 2 * slopes.energy.value / (closure * closure) * contacts.energy_density[c];
    contacts.energy_length[c] = force > 0 ? energy / force : 0;
}

/// The part that the energy density of a contact is, at the stress of its first row.
double present_part(const Model& model, Row c, double closure) {
    const Spring spring(model.sub_contacts, model.contacts.sub_contacts[c].first);
    return part_of(model.contacts.energy_density[c], spring.stress, closure);
}

/// The carriers as a batch.
Batch carriers_of(const Model& model, const JointModel& joint, Row c) {
    return {&joint, model.contacts.properties[c], model.contacts.sub_contacts[c].first, carriers, {c}};
}

/// An overlap that carries a force under a joint model that has become a curved one.
void begin_loaded(Model& model, const JointModel& joint, Row c, OverlapScratch& scratch) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    OverlapSlopes slopes;
    OverlapPatch patch =
        overlap_patch(model, pair_of(contacts, c), contacts.normal[c], offset_of(contacts, c), scratch, &slopes);
    if (!(patch.carried > 0)) return;
    press(patch, slopes, 0.5);
    const Row first = contacts.sub_contacts[c].first;
    contacts.depth[c] = patch.depth;
    for (Row s = first; s < first + carriers; ++s) {
        subs.area[s] = patch.carried / patch.depth / carriers;
        subs.normal_displacement[s] = -patch.depth;
        subs.normal_displacement_increment[s] = 0;
        subs.shear_displacement_increment.set(s, Vec3::Zero());
    }
    BatchColumns made;
    const Batch rows = carriers_of(model, joint, c);
    auto columns = columns_of(model, rows, model.clock.time_step, made);
    if (const auto failure = initialise_batch(joint, columns, subs.number.data() + first))
        throw joint_failure(model, rows, *failure);
    contacts.energy_density[c] = 0.5 * Spring(subs, first).stress * patch.depth;
    put_part(model, c, slopes, 0.5);
}

} // namespace

void press(OverlapPatch& patch, const OverlapSlopes& slopes, double part) {
    const Pressed pressed(slopes, part);
    patch.depth = slopes.closure.value;
    patch.carried = pressed.area * patch.depth;
    patch.normal = pressed.normal;
    patch.centre = pressed.centre;
    patch.twist = pressed.twist;
}

double foreseen_part(const Model& model, Row c, double closure) {
    const auto& subs = model.sub_contacts;
    const Row first = model.contacts.sub_contacts[c].first;
    const double more = closure - std::max(0.0, -subs.normal_displacement[first]);
    const Spring now(subs, first), then(std::max(0.0, now.stress + now.stiffness * more), now.stiffness);
    return part_of(model.contacts.energy_density[c] + work_between(now, then, more), then.stress, closure);
}

void settle_curved(Model& model, Row c, const OverlapSlopes& slopes, const CarriedLoad& before, double dilation) {
    auto& contacts = model.contacts;
    const auto& subs = model.sub_contacts;
    const Row first = contacts.sub_contacts[c].first;
    const double area = contacts.area[c], closure = slopes.closure.value,
                 closed = std::max(0.0, -(subs.normal_displacement[first] + dilation));
    const Spring start(before.force / area, before.stiffness / area), end(subs, first);
    double& energy = contacts.energy_density[c];
    energy += work_between(start, end, closure + dilation - closed);
    energy = std::clamp(energy, 0.0, std::max(0.0, end.stress * closure));
    put_part(model, c, slopes, present_part(model, c, closure));
}

void begin_curved(Model& model, const JointModel& joint, Row c, const OverlapSlopes& slopes, const ClosedPlace& from) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    const double closure = slopes.closure.value;
    const Batch rows = carriers_of(model, joint, c);
    for (Row s = rows.first; s < rows.first + rows.count; ++s) {
        subs.normal_force[s] = from.stress * subs.area[s];
        subs.normal_displacement[s] = -from.closure;
        subs.normal_displacement_increment[s] = from.closure - closure;
        subs.shear_displacement_increment.set(s, Vec3::Zero());
    }
    BatchColumns made;
    auto columns = columns_of(model, rows, model.clock.time_step, made);
    if (const auto failure = run_batch(joint, columns, subs.number.data() + rows.first, Guard::fenced))
        throw joint_failure(model, rows, *failure);
    for (Row s = rows.first; s < rows.first + rows.count; ++s) {
        subs.normal_displacement[s] = -closure;
        subs.normal_displacement_increment[s] = 0;
    }
    contacts.energy_density[c] = TriedSpring(model, joint, rows.first).returned(closure);
    put_part(model, c, slopes, present_part(model, c, closure));
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
    constexpr double same = 0.02, made = 2e-3; // a rocking block opens and closes its joint twice in a period
    const auto& contacts = model.contacts;
    const Row first = contacts.sub_contacts[c].first;
    const double mean = contacts.depth[c], withheld = std::min(0.5, contacts.withheld[c]),
                 force = Spring(model.sub_contacts, first).stress * contacts.area[c] / (1 - withheld),
                 energy = force * contacts.energy_length[c], density = contacts.energy_density[c];
    if (!(density > 0)) return false;
    const double area = energy / density;
    double volume = 0, square = 0, joint_force = 0, joint_energy = 0;
    for (const PlaceAhead& p : places) volume += p.area * p.closure, square += p.area * p.closure * p.closure;
    if (std::abs(volume - area * mean) > same * volume || std::abs(square - area * mean * mean) > 2 * same * square)
        return false;
    for (const PlaceAhead& p : places) {
        TriedSpring spring(model, joint, first);
        if (!spring.open(mean - p.closure)) return false;
        joint_force += p.area * spring.spring().stress;
    }
    if (std::abs(joint_force - force) > same * force) return false;
    for (const PlaceAhead& p : places) {
        TriedSpring spring(model, joint, first);
        spring.open(mean - p.closure);
        joint_energy += p.area * spring.returned(p.closure);
    }
    return joint_energy - energy <= made * energy && energy - joint_energy <= 2 * same * energy;
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
