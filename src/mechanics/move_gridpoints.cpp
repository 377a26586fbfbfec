#include "base/reduce.hpp"
#include "mechanics/motion.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 1024;

void combine(MotionSums& sum, const MotionSums& part) { sum.add(part); }

/// How far the fastest gridpoint of each deformable block has gone.
void add_travel(Model& model) {
    auto& blocks = model.blocks;
    const double step = model.clock.time_step;
    for_chunks(blocks.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            if (!blocks.deformable[b]) continue;
            double fastest = 0;
            for (Row g = blocks.gridpoints[b].first; g < blocks.gridpoints[b].end(); ++g)
                fastest = std::max(fastest, model.gridpoints.velocity[g].squaredNorm());
            blocks.travelled[b] += std::sqrt(fastest) * step;
        }
    });
}

/// Moves the velocity of a gridpoint on a quiet boundary or on rollers. What a roller pushes is the boundary's work; what
/// a quiet boundary brakes counts as damped.
void advance_on_boundary(Model& model, const QuietPoints& quiet, Row row, const DampingFactors& damping, MotionLanes& sums) {
    auto& g = model.gridpoints;
    const double mass = g.inertial_mass[row], step = model.clock.time_step;
    const std::uint8_t fixed = g.fixed[row];
    const Vec3 weight = g.mass[row] * model.settings.gravity, force = g.force[row] + g.load[row] + weight;
    Vec3 brake = Vec3::Zero(), support = Vec3::Zero();
    if (quiet.at(row)) brake = quiet_force(quiet.dashpot[quiet.index[row]], mass, g.velocity[row], force, fixed, step);
    const Lanes before = lanes(g.velocity[row]), held = prescribed(fixed);
    sums.add_power(lanes(g.force[row]) * before);
    Lanes after = damping.advance(before, lanes(force + brake), step / mass, g.last_force[row]);
    for (int k = 0; k < lane_count; ++k) after[k] = held[k] != 0 ? before[k] : after[k];
    store(g.velocity[row], after);
    if (g.roller[row] != 0) {
        const Roller& roller = model.rollers[static_cast<std::size_t>(g.roller[row])];
        const Vec3 change = roller_change(roller, g.velocity[row], fixed, roller.speed);
        g.velocity[row] += change;
        support = mass * change;
        after = lanes(g.velocity[row]);
    }
    const Lanes mean = 0.5 * (before + after);
    const Lanes rest = (mass * (after - before) - lanes(support) - lanes(force) * step) * mean;
    sums.gravity += lanes(weight) * mean * step;
    sums.boundary += (lanes(g.load[row]) * step + lanes(support)) * mean + held * rest;
    sums.damped -= (1 - held) * rest;
    sums.kinetic_before += 0.5 * mass * before * before;
    sums.kinetic += 0.5 * mass * after * after;
}

} // namespace

MotionSums move_gridpoints(Model& model, const QuietPoints& quiet) {
    auto& g = model.gridpoints;
    const Settings& settings = model.settings;
    const DampingFactors damping(settings, model.clock);
    const double step = model.clock.time_step;
    const Lanes gravity = lanes(settings.gravity);
    const MotionSums whole = reduce_chunks(
        g.size(), grain, MotionSums{},
        [&](std::size_t first, std::size_t last) {
            MotionLanes sums;
            for (std::size_t row = first; row < last; ++row) {
                if (!model.blocks.deformable[g.block[row]]) continue;
                Vec3& v = g.velocity[row];
                if (quiet.at(row) || g.roller[row] != 0)
                    advance_on_boundary(model, quiet, static_cast<Row>(row), damping, sums);
                else
                    advance_velocity(v, g.force[row], g.load[row], g.mass[row] * gravity, g.inertial_mass[row], step,
                                     g.fixed[row], damping, g.last_force[row], sums);
                const Vec3 way = v * step;
                g.displacement[row] += way;
                if (settings.large_strain) g.position[row] += way;
            }
            return sums.sums();
        },
        combine);
    if (settings.large_strain) add_travel(model);
    return whole;
}

} // namespace kaya
