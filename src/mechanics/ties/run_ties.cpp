#include "base/reduce.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/ties/ties.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace kaya {

namespace {

constexpr std::size_t grain = 256;

Vec3 weighted(const Attachment& side, const Column<Vec3>& column) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k) sum += side.weights[k] * column[side.gridpoints[k]];
    return sum;
}

/// Spin of a triangle in a step: half the difference of the displacement gradient and its transpose. Its normal stays normal to it.
Mat3 spin_of(const std::array<Vec3, 3>& middle, const std::array<Vec3, 3>& shift) {
    const Vec3 e1 = middle[1] - middle[0], e2 = middle[2] - middle[0], area = e1.cross(e2);
    const double squared = area.squaredNorm();
    const Vec3 dual1 = e2.cross(area) / squared, dual2 = area.cross(e1) / squared, n = area / std::sqrt(squared);
    Mat3 gradient = (shift[1] - shift[0]) * dual1.transpose() + (shift[2] - shift[0]) * dual2.transpose();
    gradient -= (gradient.transpose() * n).eval() * n.transpose();
    return 0.5 * (gradient - gradient.transpose());
}

/// Mean spin of the two triangles of a spring at the middle of a step, and the relative displacement of its ends.
struct Turn {
    Mat3 spin = Mat3::Zero();
    Vec3 between = Vec3::Zero();

    Turn(const Model& model, const TieLists::Spring& spring, double step) {
        const auto& points = model.gridpoints;
        for (int side = 0; side < 2; ++side) {
            std::array<Vec3, 3> middle, shift;
            for (int k = 0; k < 3; ++k) {
                const Row g = spring.side[side].gridpoints[k];
                shift[k] = step * points.velocity[g];
                middle[k] = points.position[g] - 0.5 * shift[k];
                between += (side == 0 ? -1 : 1) * spring.side[side].weights[k] * middle[k];
            }
            spin += 0.5 * spin_of(middle, shift);
        }
    }
    /// The rotation of the step, computed as for zone stresses (Hughes and Winget 1980).
    Mat3 rotation() const { return (Mat3::Identity() - 0.5 * spin).inverse() * (Mat3::Identity() + 0.5 * spin); }
};

} // namespace

ZoneSums run_ties(Model& model, const TieLists& lists, TieScratch& scratch) {
    auto& ties = model.ties;
    const double step = model.clock.time_step;
    const double damping = stiffness_damping(model.settings) / step;
    const auto& springs = lists.springs();
    const auto& means = lists.means();
    scratch.shift.resize(springs.size());
    scratch.mean.resize(means.start.empty() ? 0 : means.start.size() - 1);
    for_chunks(springs.size(), grain, [&](std::size_t first, std::size_t last) {
        const auto& v = model.gridpoints.velocity;
        for (std::size_t i = first; i < last; ++i) {
            const auto& spring = springs[i];
            Vec3 shift = step * (weighted(spring.side[1], v) - weighted(spring.side[0], v));
            if (model.settings.large_strain) {
                // A rigid rotation is not a relative displacement, even for ends that do not quite coincide.
                const Turn turn(model, spring, step);
                shift -= turn.spin * turn.between;
                Vec3& force = ties.force[spring.tie];
                force = turn.rotation() * force;
            }
            scratch.shift[i] = shift;
        }
    });
    for_chunks(scratch.mean.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            Vec3 sum = Vec3::Zero();
            for (auto m = means.begin(static_cast<Row>(i)); m != means.end(static_cast<Row>(i)); ++m)
                sum += m->part * scratch.shift[static_cast<std::size_t>(m->spring)];
            scratch.mean[i] = sum;
        }
    });
    return reduce_chunks(
        springs.size(), grain, ZoneSums{},
        [&](std::size_t first, std::size_t last) {
            ZoneSums sums;
            for (std::size_t i = first; i < last; ++i) {
                const auto& spring = springs[i];
                const Vec3& shift = scratch.shift[i];
                Vec3& force = ties.force[spring.tie];
                Vec3 held = Vec3::Zero();
                for (std::size_t k = 0; k < 3; ++k)
                    if (spring.mean[k] != no_row)
                        held += spring.part[k] * scratch.mean[static_cast<std::size_t>(spring.mean[k])];
                const Vec3 change = -spring.stiffness * held;
                sums.work -= (force + 0.5 * change).dot(shift);
                force += change;
                if (damping > 0) {
                    const Vec3 last_one = ties.dashpot[spring.tie], viscous = damping * change;
                    sums.damped -= 0.5 * (last_one + viscous).dot(shift);
                    ties.dashpot[spring.tie] = viscous;
                }
            }
            return sums;
        },
        [](ZoneSums& sum, const ZoneSums& part) {
            sum.work += part.work;
            sum.damped += part.damped;
        });
}

HistorySums follow_prescribed(Model& model, const TieLists& lists) {
    auto& points = model.gridpoints;
    HistorySums sums;
    const double step = model.clock.time_step;
    for (std::size_t i = 0; i < lists.groups(); ++i) {
        const auto members = lists.members(i);
        for (int k = 0; k < 3; ++k) {
            const auto holder = std::ranges::find_if(members, [&](Row g) { return points.fixed[g] & (1 << k); });
            if (holder == members.end()) continue;
            const double value = points.velocity[*holder][k];
            for (const Row g : members) {
                double& velocity = points.velocity[g][k];
                const double jump = value - velocity, mass = points.inertial_mass[g];
                if (jump == 0) continue;
                // The same as in apply_velocity_histories for held components.
                const double weight = points.mass[g] * model.settings.gravity[k],
                             gain = 0.5 * mass * (value * value - velocity * velocity);
                sums.kinetic += gain;
                sums.inner_power += jump * points.force[g][k];
                sums.boundary += gain + 0.5 * jump * (points.force[g][k] + weight) * step;
                sums.gravity -= 0.5 * jump * weight * step;
                velocity = value;
            }
        }
    }
    return sums;
}

void share_forces(Model& model, std::span<const Row> members) {
    auto& points = model.gridpoints;
    for (int k = 0; k < 3; ++k) {
        const auto held = [&](Row g) { return (points.fixed[g] & (1 << k)) != 0; };
        const auto rest_of = [&](Row g) { return points.load[g][k] + points.mass[g] * model.settings.gravity[k]; };
        double whole = 0, mass = 0, given = 0, held_mass = 0;
        std::size_t holders = 0;
        for (const Row g : members) {
            const double net = points.force[g][k] + rest_of(g);
            whole += net;
            mass += points.inertial_mass[g];
            if (held(g)) {
                held_mass += points.inertial_mass[g];
                ++holders;
            } else given += net;
        }
        if (holders == members.size()) continue;
        for (const Row g : members) {
            double& force = points.force[g][k];
            if (holders == 0) force = points.inertial_mass[g] / mass * whole - rest_of(g);
            else if (held(g)) force += points.inertial_mass[g] / held_mass * given;
            else force = -rest_of(g);
        }
    }
}

} // namespace kaya
