#include "base/reduce.hpp"
#include "mechanics/damping.hpp"
#include "mechanics/phases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 256;

void combine(MotionSums& sum, const MotionSums& part) { sum.add(part); }

Eigen::Quaterniond quaternion(const Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }

/// Rotation by a vector (angle times axis). Steps are small: below a thousandth of a turn the series is
/// exact to the last bit and much faster than the functions.
Eigen::Quaterniond turned_by(const Vec3& angle) {
    const double half2 = 0.25 * angle.squaredNorm();
    double cosine, sine_over; // of half the angle; sine over the angle
    if (half2 < 1e-5) {
        cosine = 1 - half2 / 2 * (1 - half2 / 12 * (1 - half2 / 30));
        sine_over = 0.5 * (1 - half2 / 6 * (1 - half2 / 20));
    } else {
        const double half = std::sqrt(half2);
        cosine = std::cos(half);
        sine_over = 0.5 * std::sin(half) / half;
    }
    return {cosine, sine_over * angle.x(), sine_over * angle.y(), sine_over * angle.z()};
}

/// Turns a block with angular momentum `momentum` for one step by the implicit midpoint rule: the
/// velocity of the middle of the step, found by fixed-point iteration, carries it from end to end.
/// Momentum is kept to the last bit and energy has no drift (Simo and Wong 1991, Int. J. Numer. Meth.
/// Eng. 31).
Vec3 turn(Quaternion& orientation, const Mat3& inertia, const Vec3& momentum, double step) {
    const Mat3 inverse = inertia.inverse();
    const Eigen::Quaterniond start = quaternion(orientation);
    const auto velocity_at = [&](const Eigen::Quaterniond& q) -> Vec3 {
        const Mat3 r = q.toRotationMatrix();
        return r * (inverse * (r.transpose() * momentum));
    };
    Vec3 velocity = velocity_at(start);
    for (int i = 0; i < 8; ++i) {
        const Vec3 before = velocity;
        velocity = velocity_at(turned_by(0.5 * step * velocity) * start);
        if ((velocity - before).squaredNorm() <= 1e-30 * velocity.squaredNorm()) break;
    }
    const Eigen::Quaterniond end = (turned_by(step * velocity) * start).normalized();
    orientation = Quaternion(end.w(), end.x(), end.y(), end.z());
    return velocity;
}

/// Positions and velocities of the vertices follow the block. Returns the longest way of one.
double place_vertices(Model& model, std::size_t b) {
    const auto& blocks = model.blocks;
    auto& g = model.gridpoints;
    const Mat3 r = quaternion(blocks.orientation[b]).toRotationMatrix();
    double travel = 0;
    for (Row row = blocks.gridpoints[b].first; row < blocks.gridpoints[b].end(); ++row) {
        const Vec3 arm = r * g.reference[row];
        const Vec3 place = blocks.centroid[b] + arm;
        const Vec3 way = place - g.position[row];
        g.velocity[row] = blocks.velocity[b] + blocks.rotational_velocity[b].cross(arm);
        g.displacement[row] += way;
        g.position[row] = place;
        travel = std::max(travel, way.squaredNorm());
    }
    return std::sqrt(travel);
}

} // namespace

MotionSums move_blocks(Model& model) {
    auto& blocks = model.blocks;
    const Settings& settings = model.settings;
    const DampingFactors damping(settings, model.clock);
    const double step = model.clock.time_step;
    return reduce_chunks(
        blocks.size(), grain, MotionSums{},
        [&](std::size_t first, std::size_t last) {
            MotionSums sums;
            for (std::size_t b = first; b < last; ++b) {
                if (blocks.deformable[b]) continue;
                const std::uint8_t fixed = blocks.fixed[b];
                Vec3& v = blocks.velocity[b];
                Vec3& w = blocks.rotational_velocity[b];
                if (fixed == fix_all && v.isZero(0) && w.isZero(0)) continue;

                const double mass = blocks.mass[b];
                const Vec3 weight = mass * settings.gravity;
                const Vec3 force = blocks.force[b] + blocks.load[b] + weight;
                for (int k = 0; k < 3; ++k) {
                    const bool held = fixed & (1 << k);
                    const double before = v[k];
                    if (!held) v[k] = damping.advance(before, force[k], mass, step);
                    sums.account(mass, before, v[k], weight[k], blocks.load[b][k], force[k] * step, held, step);
                }
                const Vec3 way = v * step;

                // Moments act on the angular momentum; its viscous part decays like the velocity.
                const Vec3 moment = blocks.moment[b] + blocks.torque[b];
                Vec3& momentum = blocks.angular_momentum[b];
                const Vec3 momentum_before = momentum, spin_before = w;
                for (int k = 0; k < 3; ++k) momentum[k] = damping.advance(momentum[k], moment[k], 1.0, step);
                const Mat3 inertia = blocks.inertia[b] * (mass / blocks.volume[b]);
                if (fixed & (fix_rx | fix_ry | fix_rz)) {
                    // Prescribed components keep their velocity; the momentum follows from it.
                    const Mat3 r = quaternion(blocks.orientation[b]).toRotationMatrix();
                    const Mat3 global = r * inertia * r.transpose();
                    Vec3 free = global.ldlt().solve(momentum);
                    for (int k = 0; k < 3; ++k)
                        if (!(fixed & (fix_rx << k))) w[k] = free[k];
                    momentum = global * w;
                    if (settings.large_strain) {
                        const auto q = (turned_by(step * w) * quaternion(blocks.orientation[b])).normalized();
                        blocks.orientation[b] = Quaternion(q.w(), q.x(), q.y(), q.z());
                    }
                } else if (!momentum.isZero(0)) {
                    Quaternion turned = blocks.orientation[b];
                    w = turn(turned, inertia, momentum, step);
                    if (settings.large_strain) blocks.orientation[b] = turned;
                } else {
                    w.setZero();
                }
                blocks.displacement[b] += way;
                if (settings.large_strain) {
                    blocks.centroid[b] += way;
                    blocks.travelled[b] += place_vertices(model, b);
                }
                // The same account for rotation, component by component of the mean spin.
                const Vec3 mean = 0.5 * (spin_before + w);
                const Vec3 rest = momentum - momentum_before - moment * step;
                for (int k = 0; k < 3; ++k) {
                    sums.boundary += blocks.torque[b][k] * mean[k] * step;
                    (fixed & (fix_rx << k) ? sums.boundary : sums.damped) +=
                        (fixed & (fix_rx << k) ? 1 : -1) * rest[k] * mean[k];
                }
                sums.kinetic_before += 0.5 * spin_before.dot(momentum_before);
                sums.kinetic += 0.5 * w.dot(momentum);
            }
            return sums;
        },
        combine);
}

} // namespace kaya
