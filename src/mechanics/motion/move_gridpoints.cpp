#include "mechanics/motion/move_gridpoints.hpp"

#include "base/reduce.hpp"
#include "mechanics/common/block_chunks.hpp"
#include "mechanics/motion/motion.hpp"
#include "mechanics/motion/move_plain.hpp"
#include "mechanics/motion/plain_rows.hpp"
#include "mechanics/ties/ties.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Adds the displacement of the fastest gridpoint of a deformable block.
void add_travel(Model& model, Row block) {
    const Span points = model.blocks.gridpoints[block];
    const auto& velocity = model.gridpoints.velocity;
    Eight squares{};
    Row g = points.first;
    for (; g + eight <= points.end(); g += eight) {
        const Eight3 v = columns_of(load_three(velocity[g].data()));
        squares = larger_of(v.x * v.x + v.y * v.y + v.z * v.z, squares);
    }
    double fastest = largest(squares);
    for (; g < points.end(); ++g) fastest = std::max(fastest, velocity[g].squaredNorm());
    model.blocks.travelled[block] += std::sqrt(fastest) * model.clock.time_step;
}

/// A point that moves: a gridpoint, or several that are tied to each other.
struct MovingPoint {
    double mass, inertial_mass;
    Vec3 force, load;
    std::uint8_t fixed;
    const Roller& roller;
    bool quiet = false;
    Mat3 dashpot = Mat3::Zero(); ///< of a quiet boundary
};

/// Advances the velocity of a point on a quiet boundary or on rollers. The work of a roller's reaction is the boundary's; the work of a
/// quiet boundary counts as damped.
void advance_on_boundary(const Model& model, const MovingPoint& point, const DampingFactors& damping, Vec3& velocity,
                         Vec3& last_force, MotionLanes& sums) {
    const double mass = point.inertial_mass, step = model.clock.kick();
    const Vec3 weight = point.mass * model.settings.gravity, force = point.force + point.load + weight;
    Vec3 brake = Vec3::Zero(), support = Vec3::Zero();
    if (point.quiet) brake = quiet_force(point.dashpot, mass, velocity, force, point.fixed, step);
    const Lanes before = lanes(velocity), held = prescribed(point.fixed);
    const bool rolls = point.roller.count != 0;
    Vec3 against = Vec3::Zero();
    if (rolls && damping.combined != 0) against = support_against(force + brake, point.roller, point.fixed);
    Lanes after = damping.advance(before, lanes(force + brake + against), step / mass, last_force);
    for (int k = 0; k < lane_count; ++k) after[k] = held[k] != 0 ? before[k] : after[k];
    store(velocity, after);
    if (rolls) {
        const Vec3 change = roller_change(point.roller, velocity, point.fixed, point.roller.speed);
        velocity += change;
        support = mass * change + step * against;
        after = lanes(velocity);
    }
    sums.add_power(lanes(point.force), before, after);
    const Lanes mean = 0.5 * (before + after);
    const Lanes rest = (mass * (after - before) - lanes(support) - lanes(force) * step) * mean;
    sums.gravity += lanes(weight) * mean * step;
    sums.boundary += (lanes(point.load) * step + lanes(support)) * mean + held * rest;
    sums.damped -= (1 - held) * rest;
    sums.kinetic_before += 0.5 * mass * before * before;
    sums.kinetic += 0.5 * mass * after * after;
}

bool any_quiet(const QuietPoints& quiet, std::size_t row) {
    bool any = false;
    for (std::size_t l = row; l < row + 8; ++l) any |= quiet.at(l);
    return any;
}

void place(Model& model, Row row) {
    auto& g = model.gridpoints;
    const Vec3 shift = g.velocity[row] * model.clock.time_step;
    g.displacement[row] += shift;
    if (model.settings.large_strain) g.position[row] += shift;
}

/// The velocity of a group before a step: its common velocity; after an impact of parts, or when a script has set one member's, the mean by
/// mass. The first held member gives the velocity.
Vec3 common_velocity(const Model& model, std::span<const Row> members) {
    const auto& g = model.gridpoints;
    Vec3 velocity = g.velocity[members.front()];
    if (std::ranges::any_of(members, [&](Row row) { return g.velocity[row] != velocity; })) {
        double mass = 0;
        velocity.setZero();
        for (const Row row : members) {
            velocity += g.inertial_mass[row] * g.velocity[row];
            mass += g.inertial_mass[row];
        }
        velocity /= mass;
    }
    for (int k = 0; k < 3; ++k) {
        const auto holder = std::ranges::find_if(members, [&](Row row) { return g.fixed[row] & (1 << k); });
        if (holder != members.end()) velocity[k] = g.velocity[*holder][k];
    }
    return velocity;
}

void move_group(Model& model, std::span<const Row> members, const Roller& roller, const QuietPoints& quiet,
                const DampingFactors& damping, MotionLanes& sums) {
    auto& g = model.gridpoints;
    MovingPoint point{0, 0, Vec3::Zero(), Vec3::Zero(), 0, roller};
    for (const Row row : members) {
        point.mass += g.mass[row];
        point.inertial_mass += g.inertial_mass[row];
        point.force += g.force[row];
        point.load += g.load[row];
        point.fixed |= g.fixed[row];
        if (!quiet.at(row)) continue;
        point.quiet = true;
        point.dashpot += quiet.dashpot[quiet.index[row]];
    }
    Vec3 velocity = common_velocity(model, members), last_force = g.last_force[members.front()];
    if (point.quiet || roller.count != 0) advance_on_boundary(model, point, damping, velocity, last_force, sums);
    else
        advance_velocity(velocity, point.force, point.load, point.mass * lanes(model.settings.gravity),
                         point.inertial_mass, model.clock.kick(), point.fixed, damping, last_force, sums);
    for (const Row row : members) {
        g.velocity[row] = velocity;
        g.last_force[row] = last_force;
        place(model, row);
    }
}

} // namespace

GridpointMotion::GridpointMotion(Model& model, const QuietPoints& quiet, const TieLists& ties)
    : model_(model), quiet_(quiet), ties_(ties), damping_(model.settings, model.clock),
      gravity_(lanes(model.settings.gravity)), travels_(model.settings.large_strain) {}

void GridpointMotion::move_point(Row row, MotionLanes& sums) {
    auto& g = model_.gridpoints;
    Vec3& v = g.velocity[row];
    if (quiet_.at(row) || g.roller[row] != 0) {
        MovingPoint point{g.mass[row], g.inertial_mass[row], g.force[row],
                          g.load[row], g.fixed[row],         model_.rollers[static_cast<std::size_t>(g.roller[row])]};
        point.quiet = quiet_.at(row);
        if (point.quiet) point.dashpot = quiet_.dashpot[quiet_.index[row]];
        advance_on_boundary(model_, point, damping_, v, g.last_force[row], sums);
    } else {
        advance_velocity(v, g.force[row], g.load[row], g.mass[row] * gravity_, g.inertial_mass[row],
                         model_.clock.kick(), g.fixed[row], damping_, g.last_force[row], sums);
    }
    place(model_, row);
}

MotionSums GridpointMotion::move(std::size_t first, std::size_t last) {
    auto& g = model_.gridpoints;
    MotionLanes sums;
    PlainGridpoints plain(model_);
    for (std::size_t row = first; row < last; ++row) {
        if (const Row b = g.block[row]; !model_.blocks.deformable[b]) {
            row = static_cast<std::size_t>(model_.blocks.gridpoints[b].end()) - 1;
            continue;
        }
        if (last - row >= 8 && are_plain(model_, ties_, row) && !any_quiet(quiet_, row)) {
            plain.move(row);
            row += 7;
            continue;
        }
        if (!ties_.in_group(static_cast<Row>(row))) move_point(static_cast<Row>(row), sums);
    }
    if (travels_ && ties_.groups() == 0)
        for_deformable_in(model_, first, last, [&](Row block) { add_travel(model_, block); });
    MotionSums both = sums.sums();
    both.add(plain.sums());
    return both;
}

MotionSums GridpointMotion::finish(MotionSums whole) {
    const auto combine = [](MotionSums& sum, const MotionSums& part) { sum.add(part); };
    whole = reduce_chunks(
        ties_.groups(), grain, whole,
        [&](std::size_t first, std::size_t last) {
            MotionLanes sums;
            for (std::size_t i = first; i < last; ++i)
                move_group(model_, ties_.members(i), ties_.roller(i), quiet_, damping_, sums);
            return sums.sums();
        },
        combine);
    if (travels_)
        for_chunks(model_.blocks.size(), 16, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b)
                if (model_.blocks.deformable[b] &&
                    (ties_.groups() != 0 || !in_one_chunk(model_.blocks.gridpoints[b], grain)))
                    add_travel(model_, static_cast<Row>(b));
        });
    return whole;
}

MotionSums move_gridpoints(Model& model, const QuietPoints& quiet, const TieLists& ties) {
    GridpointMotion motion(model, quiet, ties);
    return motion.finish(reduce_chunks(
        model.gridpoints.size(), GridpointMotion::grain, MotionSums{},
        [&](std::size_t first, std::size_t last) { return motion.move(first, last); },
        [](MotionSums& sum, const MotionSums& part) { sum.add(part); }));
}

} // namespace kaya
