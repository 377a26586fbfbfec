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

} // namespace

MotionSums move_gridpoints(Model& model) {
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
