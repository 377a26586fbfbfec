#include "mechanics/step/energy.hpp"

#include "model/measure/measure.hpp"

#include <cmath>

namespace kaya {

double energy_in_zones(const Model& model, const std::vector<ElasticConstants>& elastic) {
    double sum = 0;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        if (!model.blocks.deformable[b]) continue;
        const double bulk = elastic[b].bulk(), two_shear = elastic[b].two_shear;
        if (!(two_shear > 0)) continue;
        const Span zones = model.blocks.zones[b];
        for (Row z = zones.first; z < zones.end(); ++z) {
            const Stress& s = model.zones.stress[z];
            const double mean = (s[0] + s[1] + s[2]) / 3;
            const double deviator = (s.head<3>().array() - mean).square().sum() + 2 * s.tail<3>().squaredNorm();
            sum += zone_volume(model, z) * (mean * mean / (2 * bulk) + deviator / (2 * two_shear));
        }
    }
    return sum;
}

void keep_account(Model& model, const StepSums& step) {
    const auto& [prescribed, motion, joints, zones, fluid, structure_work, inner_power] = step;
    Energy& energy = model.energy;
    // The energy of velocities set from outside since the last step is added to the initial energy of the account.
    energy.start += motion.kinetic_before - prescribed.kinetic - energy.kinetic;
    energy.kinetic = motion.kinetic;
    // The half step before such a change belongs to the earlier velocities, not to those that the bodies have now.
    const double power_set = motion.inner_power - prescribed.inner_power - energy.inner_power;
    const double half_step = 0.5 * model.clock.time_step;
    const bool opens = energy.lag == 0; // the half step before is unknown
    const double half_step_before = 0.5 * energy.step_before(model.clock.step_before());
    energy.inner_power = inner_power;
    energy.lag = half_step;
    if (!model.settings.energy) return;
    constexpr double rounding_of_sums = 1e-12;
    if (std::abs(power_set) > rounding_of_sums * motion.inner_power_size)
        (opens ? energy.start : energy.boundary) += half_step_before * power_set;
    energy.gravity += prescribed.gravity + motion.gravity;
    energy.boundary += prescribed.boundary + motion.boundary + fluid;
    energy.damped += motion.damped + joints.damped + zones.damped;
    energy.joint_work += joints.work;
    energy.joint_friction += joints.friction;
    energy.joint_lost += joints.lost - joints.returned;
    energy.zone_work += zones.work;
    energy.structure_work += structure_work;
    const Clock& clock = model.clock;
    if (!(clock.last_step > 0)) return;
    energy.step_made -= 0.25 * (clock.time_step - clock.last_step) * motion.inner_power_gain;
    // After a command that shortens the step forces act for less than half of the step before.
    energy.step_made -= (half_step_before - 0.5 * clock.last_step) * motion.inner_power;
}

} // namespace kaya
