#include "mechanics/contact/dashpots.hpp"

#include "mechanics/contact/contact_stiffness.hpp"
#include "mechanics/contact/contact_kind.hpp"
#include "mechanics/contact/contact_work.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// 1 over the mass of the body on one side of a contact; 0 if it is held in all directions.
double inverse_mass(const Model& model, Row block) {
    const auto& blocks = model.blocks;
    const bool held = !blocks.deformable[block] && (blocks.fixed[block] & 7) == 7;
    return held || blocks.inertial_mass[block] <= 0 ? 0 : 1 / blocks.inertial_mass[block];
}

/// By how much more a sub-contact closes in a step than its sides move towards each other; `more`: growth of its normal force. No joint dilates by more than
/// it slips.
double dilation_of(const SubContacts& subs, Row s, double more) {
    constexpr double rounding = 1e-12; // of the closure
    const double stiffness = subs.normal_stiffness[s] * subs.area[s],
                 slip = Vec3(subs.shear_displacement_increment[s]).norm();
    if (!(stiffness > 0)) return 0;
    const double dilation = more / stiffness + subs.normal_displacement_increment[s];
    return std::abs(dilation) > rounding * subs.normal_force[s] / stiffness ? std::clamp(dilation, -slip, slip) : 0;
}

} // namespace

void drop_idle_dashpots(Model& model) {
    if (joints_are_damped(model.settings)) return;
    std::ranges::fill(model.sub_contacts.dashpot_normal, 0.0);
    for (auto& column : model.sub_contacts.dashpot_shear.component) std::ranges::fill(column, 0.0);
    std::ranges::fill(model.zones.dashpot, Stress::Zero());
    for (auto& column : model.zones.warp_dashpot) std::ranges::fill(column, 0.0);
    std::ranges::fill(model.ties.dashpot, Vec3::Zero());
}

Beta beta_of(const Model& model, Row c) {
    const double rayleigh = stiffness_damping(model.settings);
    Beta beta{rayleigh, rayleigh};
    const double fraction = model.settings.contact_damping;
    const auto& contacts = model.contacts;
    if (fraction == 0) return beta;
    const double inverse = inverse_mass(model, contacts.block1[c]) + inverse_mass(model, contacts.block2[c]);
    if (inverse == 0) return beta;
    // A dashpot of this part of the critical one, 2 sqrt(k m), is this multiple of k.
    double normal = 0, shear = 0;
    const NormalAreaFactor factor(model, c);
    for (Row s = contacts.sub_contacts[c].first; s < contacts.sub_contacts[c].end(); ++s) {
        const Springs k = springs_of(model.sub_contacts, s, factor);
        normal += k.normal;
        shear += k.shear;
    }
    if (normal > 0) beta.normal += 2 * fraction / std::sqrt(normal * inverse);
    // The multiple of a shear spring that vanishes with the normal force is that of a thousandth of the normal one.
    if (shear > 0) beta.shear += 2 * fraction / std::sqrt(std::max(shear, 1e-3 * normal) * inverse);
    return beta;
}

BatchDashpots::BatchDashpots(Model& model, const Batch& batch, std::vector<double>& friction)
    : model_(model), batch_(batch), friction_(friction) {
    auto& s = model.sub_contacts;
    taken_ = -0.5 * work();
    if (friction_.size() < static_cast<std::size_t>(batch.count))
        friction_.resize(static_cast<std::size_t>(batch.count));
    for (Row i = 0; i < batch.count; ++i) {
        const Row row = batch.first + i;
        friction_[i] = s.frictional_work[row];
        s.dashpot_normal[row] = -s.normal_force[row];
        for (int k = 0; k < 3; ++k) s.dashpot_shear.component[k][row] = -s.shear_force.component[k][row];
    }
}

double BatchDashpots::work() const {
    const auto& s = model_.sub_contacts;
    double sum = 0;
    for (const Row c : batch_.contacts) {
        if (follows_overlap(model_, c)) continue; // its rows do not keep their places
        const Span span = model_.contacts.sub_contacts[c];
        for (Row row = span.first; row < span.end(); ++row)
            sum += s.dashpot_normal[row] * s.normal_displacement_increment[row] +
                   s.dashpot_shear[row].dot(s.shear_displacement_increment[row]);
    }
    return sum;
}

double BatchDashpots::finish() {
    auto& s = model_.sub_contacts;
    const double step = model_.clock.time_step;
    for (const Row c : batch_.contacts) {
        const Beta beta = beta_of(model_, c);
        const RelativeMotion motion(model_, c);
        const Vec3 n = model_.contacts.normal[c];
        const bool overlap = follows_overlap(model_, c);
        const Span span = model_.contacts.sub_contacts[c];
        for (Row row = span.first; row < span.end(); ++row) {
            const Vec3 shear = s.shear_force[row], slip = s.shear_displacement_increment[row],
                       grown = Vec3(s.dashpot_shear[row]) + shear;
            double more = s.dashpot_normal[row] + s.normal_force[row];
            const bool open = s.normal_force[row] == 0 && shear.isZero(0);
            // A part that has slipped or broken in this step is not elastic: only friction dissipates there.
            const bool slips = s.frictional_work[row] != friction_[row - batch_.first];
            const double dilation = slips ? dilation_of(s, row, more) : 0;
            // The halves of an overlap close by other distances than its places.
            if (overlap) more = s.normal_stiffness[row] * s.area[row] * (dilation - n.dot(motion.at(s.position[row])));
            const double normal = open ? 0 : beta.normal / step * more;
            s.dashpot_normal[row] = normal;
            // What dilation does to the dashpot the slip has to pay for.
            if (open) s.dashpot_shear.set(row, Vec3::Zero());
            else if (slips)
                s.dashpot_shear.set(row, dilation == 0 ? Vec3(Vec3::Zero())
                                                       : Vec3(-normal * dilation / slip.squaredNorm() * slip));
            else s.dashpot_shear.set(row, beta.shear / step * grown);
        }
    }
    return taken_ - 0.5 * work();
}

} // namespace kaya
