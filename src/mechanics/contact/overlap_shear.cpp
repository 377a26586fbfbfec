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

/// The shear force of a row whose joint model has changed its shear stiffness, on the shear area. A falling stiffness takes its part of the
/// force, as in the joint models that ship; a rising one adds none. What the joint model adds along the displacement is that of its area, of
/// softer springs than it reports as well. Otherwise it has limited the force, which keeps its size and turns as the stiffer springs turn it.
Vec3 stiffened(const Vec3& kept, const Vec3& step, const Vec3& now, double area, double whole, double size) {
    const Vec3 added = now - kept, most = area * step;
    const double square = most.squaredNorm(), part = square > 0 ? std::clamp(added.dot(most) / square, 0.0, 1.0) : 0;
    if ((added - part * most).norm() <= elastic * size) return kept + part * whole * step;
    const Vec3 stiffer = kept + whole * step;
    const double trial = stiffer.norm();
    return trial >= now.norm() && trial > 0 ? Vec3(now.norm() / trial * stiffer) : stiffer;
}

/// The work (10f) is that of the force which acts, less the change of the energy (10a).
void stiffen_changed(SubContacts& subs, Row s, double whole, const Vec3& old, double stiffness_before) {
    const double area = subs.area[s], stiffness = subs.shear_stiffness[s];
    const Vec3 now = subs.shear_force[s], slip = subs.shear_displacement_increment[s];
    const Vec3 force = stiffened(std::min(1.0, stiffness / stiffness_before) * old, -stiffness * slip, now, area, whole,
                                 old.norm() + now.norm());
    const auto gain = [&](double squared, double on) {
        return (squared / stiffness - old.squaredNorm() / stiffness_before) / (2 * on);
    };
    subs.frictional_work[s] +=
        0.5 * (now - force).dot(slip) + gain(now.squaredNorm(), area) - gain(force.squaredNorm(), whole);
    subs.shear_force.set(s, force);
}

} // namespace

void stiffen_shear(Model& model, Row c, const CarriedLoad& before) {
    auto& subs = model.sub_contacts;
    const Row first = model.contacts.sub_contacts[c].first;
    const double whole = shear_area(model.contacts, c) / carriers;
    for (Row s = first; s < first + carriers; ++s) {
        const double area = subs.area[s], stiffness = subs.shear_stiffness[s];
        if (!(area > 0 && stiffness > 0 && whole > area)) continue;
        const auto k = static_cast<std::size_t>(s - first);
        if (before.shear_stiffness[k] != stiffness && before.shear_stiffness[k] > 0) {
            stiffen_changed(subs, s, whole, before.shear[k], before.shear_stiffness[k]);
            continue;
        }
        const Vec3 &old = before.shear[k], now = subs.shear_force[s];
        const Vec3 step = -stiffness * Vec3(subs.shear_displacement_increment[s]), stiffer = old + whole * step;
        const bool limited = (old + area * step - now).norm() > elastic * (old.norm() + now.norm());
        if (const double size = now.norm(), trial = stiffer.norm(); limited && trial >= size && trial > 0) {
            // The force turns to the direction of slip as fast as the stiffer springs turn it.
            const Vec3 turned = size / trial * stiffer;
            subs.frictional_work[s] +=
                0.5 * (turned - now).dot(step) / stiffness +
                (now.squaredNorm() - old.squaredNorm()) / (2 * stiffness) * (1 / area - 1 / whole);
            subs.shear_force.set(s, turned);
            continue;
        }
        subs.shear_force.set(s, stiffer);
        subs.frictional_work[s] = before.worn_by_row[k];
    }
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
