#include "base/reduce.hpp"
#include "mechanics/damping.hpp"
#include "mechanics/phases.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 1024;

void combine(MotionSums& sum, const MotionSums& part) {
    sum.kinetic += part.kinetic;
    sum.damping_power += part.damping_power;
    sum.travel = std::max(sum.travel, part.travel);
}

} // namespace

MotionSums move_gridpoints(Model& model) {
    auto& g = model.gridpoints;
    const Settings& settings = model.settings;
    const DampingFactors damping(settings, model.clock);
    const double step = model.clock.time_step;
    return reduce_chunks(
        g.size(), grain, MotionSums{},
        [&](std::size_t first, std::size_t last) {
            MotionSums sums;
            for (std::size_t row = first; row < last; ++row) {
                if (!model.blocks.deformable[g.block[row]]) continue;
                const double mass = g.mass[row];
                const Vec3 force = g.force[row] + g.load[row] + mass * settings.gravity;
                Vec3& v = g.velocity[row];
                for (int k = 0; k < 3; ++k)
                    if (!(g.fixed[row] & (1 << k))) v[k] = damping.advance(v[k], force[k], mass, step);
                const Vec3 way = v * step;
                g.displacement[row] += way;
                if (settings.large_strain) g.position[row] += way;
                const double v2 = v.squaredNorm();
                sums.kinetic += 0.5 * mass * v2;
                sums.damping_power += damping.viscous * mass * v2;
                sums.travel = std::max(sums.travel, std::sqrt(v2) * step);
            }
            return sums;
        },
        combine);
}

} // namespace kaya
