#include "mechanics/contact/overlap_shear.hpp"

#include "mechanics/shape/overlap_patch.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

double shear_energy(const Model& model, Row c) {
    const auto& subs = model.sub_contacts;
    const Row first = model.contacts.sub_contacts[c].first;
    const double area = shear_area(model.contacts, c) / carriers;
    double energy = 0;
    for (Row s = first; s < first + carriers; ++s)
        if (const double stiffness = subs.shear_stiffness[s] * area; stiffness > 0)
            energy += 0.5 * Vec3(subs.shear_force[s]).squaredNorm() / stiffness;
    return energy;
}

void scale_shear(SubContacts& subs, Span rows, double scale) {
    for (Row s = rows.first; s < rows.end(); ++s) subs.shear_force.set(s, scale * Vec3(subs.shear_force[s]));
}

double pay_for_area(Model& model, Row c, double before) {
    double& taken = model.contacts.withdrawn_energy[c];
    double after = shear_energy(model, c);
    if (after > before + taken) {
        scale_shear(model.sub_contacts, model.contacts.sub_contacts[c], std::sqrt((before + taken) / after));
        after = before + taken;
    }
    taken = std::max(0.0, taken + before - after);
    return before - after;
}

namespace {

constexpr double elastic = 1e-9; // of the forces

/// One carrier in one step, before and after its joint model; `whole` is its shear area.
struct CarrierStep {
    Vec3 old, held, now, slip; ///< held: what the joint model leaves of the old one without slip
    double stiffness_before, stiffness, area, whole;

    /// A row without shear stiffness before, such as an open one, holds no force.
    bool changes_stiffness() const { return stiffness_before != stiffness && stiffness_before > 0; }
    double size() const { return old.norm() + now.norm(); }
    /// Elastic increment per area.
    Vec3 step() const { return -stiffness * slip; }
};

/// Shear force on the shear area, and whether the joint model has limited it.
struct Stiffened {
    Vec3 force;
    bool limited;
};

/// The force keeps its size, and turns to the direction of slip as fast as the stiffer springs turn it.
Stiffened turned(const Vec3& stiffer, const Vec3& now) {
    const double size = now.norm(), trial = stiffer.norm();
    return {trial >= size && trial > 0 ? Vec3(size / trial * stiffer) : stiffer, trial >= size && trial > 0};
}

Stiffened stiffened(const CarrierStep& c) {
    const Vec3 stiffer = c.old + c.whole * c.step();
    if ((c.old + c.area * c.step() - c.now).norm() > elastic * c.size()) return turned(stiffer, c.now);
    return {stiffer, false};
}

/// The same for a joint model that has changed its shear stiffness. What it adds along the displacement is that of its area, of softer springs than
/// it reports as well.
Stiffened stiffened_by_change(const CarrierStep& c) {
    const Vec3 added = c.now - c.held, most = c.area * c.step();
    const double square = most.squaredNorm(), part = square > 0 ? std::clamp(added.dot(most) / square, 0.0, 1.0) : 0;
    const Vec3 more = (c.whole - c.area) * c.step();
    if ((added - part * most).norm() <= elastic * c.size()) return {c.now + part * more, false};
    const Vec3 stiffer = c.now + more;
    const double size = stiffer.norm();
    return {size > 0 ? Vec3(c.now.norm() / size * stiffer) : c.now, true};
}

/// A joint model that limits a shear force shows the ratio to the normal force that it grants; one that grants more to another carrier shows that
/// there is no such ratio.
struct ShownGrip {
    double limited = 0, granted = 0; ///< greatest ratios of carriers that are limited, and of those that are not

    void note(bool is_limited, double shear, double normal) {
        if (!(normal > 0)) return;
        double& most = is_limited ? limited : granted;
        most = std::max(most, shear / normal);
    }
    double after(double before) const {
        const double grip = limited > 0 ? limited : before;
        return granted > (1 + elastic) * grip ? 0 : grip;
    }
};

/// What (10b) and (10f) add to the work of the joint model: the work of the force that acts, less the change of the energy (10a).
double more_friction(const CarrierStep& c, const Vec3& force) {
    const double before = c.changes_stiffness() ? c.stiffness_before : c.stiffness;
    const auto gain = [&](const Vec3& now, double on) {
        return (now.squaredNorm() / c.stiffness - c.old.squaredNorm() / before) / (2 * on);
    };
    return 0.5 * (c.now - force).dot(c.slip) + gain(c.now, c.area) - gain(force, c.whole);
}

} // namespace

void hold_by_grip(Model& model, Row c, const CarrierRows& rows) {
    // The joint model decides on the rest. One that is curved has another stress than straight springs, and keeps it where it dilates.
    constexpr double margin = 2;
    auto& subs = model.sub_contacts;
    const bool curved = model.contacts.curved[c] != 0;
    const double grip = model.contacts.grip[c], whole = shear_area(model.contacts, c) / carriers;
    const Row first = model.contacts.sub_contacts[c].first;
    for (Row k = 0; grip > 0 && k < carriers; ++k) {
        const Row s = first + k;
        const Vec3 force = subs.shear_force[s];
        const double stress = subs.area[s] > 0 ? subs.normal_force[s] / subs.area[s] : 0, held = margin * grip,
                     most = curved ? held * stress * rows.area
                                   : held * subs.normal_stiffness[s] * rows.area *
                                         rows.closure[static_cast<std::size_t>(k)];
        if (!(force.norm() > most && subs.shear_stiffness[s] > 0)) continue;
        const double scale = most / force.norm();
        subs.frictional_work[s] += (1 - scale * scale) * force.squaredNorm() / (2 * subs.shear_stiffness[s] * whole);
        subs.shear_force.set(s, scale * force);
    }
}

void stiffen_shear(Model& model, Row c, const CarriedLoad& before) {
    auto& subs = model.sub_contacts;
    const double whole = shear_area(model.contacts, c) / carriers, grip = model.contacts.grip[c];
    const Row first = model.contacts.sub_contacts[c].first;
    ShownGrip shown;
    for (Row k = 0; k < carriers; ++k) {
        const Row s = first + k;
        const auto i = static_cast<std::size_t>(k);
        const CarrierStep step{before.shear[i],
                               before.held[i],
                               subs.shear_force[s],
                               subs.shear_displacement_increment[s],
                               before.shear_stiffness[i],
                               subs.shear_stiffness[s],
                               subs.area[s],
                               whole};
        if (!(step.area > 0 && step.stiffness > 0)) continue;
        const bool changes = step.changes_stiffness();
        Stiffened stiff = changes ? stiffened_by_change(step) : stiffened(step);
        const double normal = subs.normal_force[s], size = step.now.norm();
        shown.note(stiff.limited, size, normal);
        if (!(whole > step.area)) continue;
        // The joint model has seen less of the force than its springs would have: friction that it has shown holds for the rest.
        const double most = std::max(size, grip * normal), trial = stiff.force.norm();
        if (grip > 0 && trial > most) stiff = {most / trial * stiff.force, true};
        subs.shear_force.set(s, stiff.force);
        if (stiff.limited || changes) subs.frictional_work[s] += more_friction(step, stiff.force);
        else subs.frictional_work[s] = before.worn_by_row[i];
    }
    model.contacts.grip[c] = shown.after(grip);
}

SlippedCarriers slipped_carriers(const Model& model, Row c, const CarriedLoad& before) {
    constexpr double rounding = 1e-9; // of the work of the shear force
    const auto& subs = model.sub_contacts;
    const Row first = model.contacts.sub_contacts[c].first;
    SlippedCarriers slipped{};
    for (std::size_t k = 0; k < slipped.size(); ++k) {
        const Row s = first + static_cast<Row>(k);
        const double worn = std::abs(subs.frictional_work[s] - before.worn_by_row[k]);
        slipped[k] = worn > 0 && worn > rounding * (before.shear[k].norm() + Vec3(subs.shear_force[s]).norm()) *
                                            Vec3(subs.shear_displacement_increment[s]).norm();
    }
    return slipped;
}

double release_places(Model& model, Row c, const SlippedCarriers& slipped) {
    auto& subs = model.sub_contacts;
    const Row first = model.contacts.sub_contacts[c].first;
    const RelativeMotion motion(model, c);
    const Vec3 turn = motion.two.turn - motion.one.turn;
    double lost = 0;
    for (std::size_t k = 0; k < slipped.size(); ++k) {
        if (!slipped[k]) continue;
        const Row s = first + static_cast<Row>(k);
        lost -= 0.5 * Vec3(subs.shear_force[s]).dot(turn.cross(Vec3(subs.shear_arm[s])));
        subs.shear_arm.set(s, Vec3::Zero());
    }
    return lost;
}

} // namespace kaya
