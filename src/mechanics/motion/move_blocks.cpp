#include "mechanics/motion/move_bodies.hpp"
#include "base/reduce.hpp"
#include "mechanics/supports/held_directions.hpp"
#include "mechanics/motion/motion.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "mechanics/motion/move_plain_blocks.hpp"
#include "mechanics/lanes/turn.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 256;

void combine(MotionSums& sum, const MotionSums& part) { sum.add(part); }

Rotor rotor(const Quaternion& q) { return {q[0], {q[1], q[2], q[3]}}; }
Quaternion quaternion_of(const Rotor& r) { return {r.w, r.v.x, r.v.y, r.v.z}; }

/// Positions of the vertices of a block after its motion.
class VertexPlaces {
public:
    VertexPlaces(const Vec3& centroid, const Mat3& turn) : centroid_(centroid), turn_(turn) {
        eight_centroid_ = for_each_row(centroid);
        for (int k = 0; k < 3; ++k) eight_turn_[k] = for_each_row(turn.col(k));
    }
    /// For rows [row, row + 8), with the operations and their order of a single row. Returns the square of the longest displacement.
    double place_eight(Gridpoints& g, Row row) const {
        const Eight3 x = columns_of(load_three(g.reference[row].data()));
        const std::array<ThreeEights, 3> of{for_each_of_three(x.x), for_each_of_three(x.y), for_each_of_three(x.z)};
        ThreeEights place = load_three(g.position[row].data()), squares,
                    displacement = load_three(g.displacement[row].data());
        for (std::size_t i = 0; i < 3; ++i) {
            const Eight there = eight_centroid_[i] + of[0][i] * eight_turn_[0][i] + of[1][i] * eight_turn_[1][i] +
                                of[2][i] * eight_turn_[2][i];
            const Eight shift = there - place[i];
            displacement[i] += shift;
            place[i] = there;
            squares[i] = shift * shift;
        }
        store(g.displacement[row].data(), displacement);
        store(g.position[row].data(), place);
        const Eight3 square = columns_of(squares);
        return largest(square.x + square.y + square.z);
    }
    double place_one(Gridpoints& g, Row row) const {
        const Vec3 x = g.reference[row];
        const Vec3 place = centroid_ + x[0] * turn_.col(0) + x[1] * turn_.col(1) + x[2] * turn_.col(2);
        const Vec3 shift = place - g.position[row];
        g.displacement[row] += shift;
        g.position[row] = place;
        return shift[0] * shift[0] + shift[1] * shift[1] + shift[2] * shift[2];
    }

private:
    Vec3 centroid_;
    Mat3 turn_;
    ThreeEights eight_centroid_;
    std::array<ThreeEights, 3> eight_turn_;
};

/// Moves the vertices with the block. Returns the longest displacement.
double place_vertices(Model& model, std::size_t b) {
    const auto& blocks = model.blocks;
    const VertexPlaces places(blocks.centroid[b], quaternion(blocks.orientation[b]).toRotationMatrix());
    const Span span = blocks.gridpoints[b];
    double travel = 0;
    Row row = span.first;
    for (; row + eight <= span.end(); row += eight)
        travel = std::max(travel, places.place_eight(model.gridpoints, row));
    for (; row < span.end(); ++row) travel = std::max(travel, places.place_one(model.gridpoints, row));
    return std::sqrt(travel);
}

/// In small strain the vertices stay; only their displacement is counted.
void displace_vertices(Model& model, std::size_t b) {
    const Span span = model.blocks.gridpoints[b];
    for (Row row = span.first; row < span.end(); ++row)
        model.gridpoints.displacement[row] += gridpoint_velocity(model, row) * model.clock.time_step;
}

/// One rigid block, or several joined ones: its forces and its motion. Inertia is in the axes that the orientation turns.
struct RigidBody {
    double mass;               ///< in the weight
    double inertial_mass;      ///< in the equation of motion, as in the inertia
    const Mat3& inertia_shape; ///< inertia over
    double inertia_scale;      ///< this
    std::uint8_t fixed;
    const Vec3 &force, &load, &moment, &torque;
    const Mat3& load_arms; ///< sum of arm (in the axes of the inertia) times force, for loads that move with the body
    Vec3 &velocity, &spin, &momentum;
    Vec3 &last_force, &last_moment; ///< for combined damping
    Quaternion& orientation;
    const Roller* roller; ///< held directions; null: none
};

/// Work of forces of constant direction on points that turn with a body: force times displacement, between the middles of two steps, as all
/// work on bodies; `arms` is the present sum of arm times force.
double work_on_arms(const Mat3& arms, const Vec3& turn_before, const Vec3& turn_now) {
    const auto turn = [](const Vec3& angle) {
        const Rotor r = Rotor::by(Triple(angle));
        return quaternion(quaternion_of(r)).toRotationMatrix();
    };
    const Mat3 shift = turn(turn_now) - turn(-turn_before);
    return 0.5 * shift.cwiseProduct(arms.transpose()).sum();
}

/// Velocities and momentum after one step, and the orientation in large strain.
inline void advance(const RigidBody& body, const Settings& settings, const Clock& clock, const DampingFactors& damping,
                    MotionLanes& sums) {
    const unsigned fixed = body.fixed;
    const double step = clock.time_step, kick = clock.kick();
    Vec3& w = body.spin;
    advance_velocity(body.velocity, body.force, body.load, body.mass * lanes(settings.gravity), body.inertial_mass,
                     kick, fixed & (fix_x | fix_y | fix_z), damping, body.last_force, sums, body.roller);

    // Moments act on the angular momentum; its viscous part decays like the velocity.
    Vec3& momentum = body.momentum;
    const bool has_arms = !body.load_arms.isZero(0);
    Mat3 arms = Mat3::Zero();
    if (has_arms) arms = quaternion(body.orientation).toRotationMatrix() * body.load_arms;
    const Vec3 turning = moment_of(arms), spin_then = w;
    const Lanes torque = lanes(body.torque), moment = lanes(body.moment) + torque + lanes(turning);
    const Lanes momentum_before = lanes(momentum), spin_before = lanes(w);
    store(momentum, damping.advance(momentum_before, moment, kick, body.last_moment));
    if (fixed & (fix_rx | fix_ry | fix_rz)) {
        // Prescribed components keep their velocity; the others follow from their momentum.
        const Mat3 r = quaternion(body.orientation).toRotationMatrix();
        const Mat3 global = r * (body.inertia_scale * body.inertia_shape) * r.transpose();
        Mat3 system = global;
        Vec3 right = momentum;
        for (int k = 0; k < 3; ++k)
            if (fixed & (fix_rx << k)) {
                system.row(k) = Vec3::Unit(k).transpose();
                right[k] = w[k];
            }
        w = system.partialPivLu().solve(right);
        for (int k = 0; k < 3; ++k)
            if (fixed & (fix_rx << k)) w[k] = right[k];
        momentum = global * w;
        if (settings.large_strain) {
            body.orientation = quaternion_of(Rotor::by(step * Triple(w)) * rotor(body.orientation)).normalized();
        }
    } else if (!momentum.isZero(0)) {
        Rotor turned = rotor(body.orientation);
        const double turning_step = settings.large_strain ? step : 0; // in small strain the inertia stays as well
        w = turn(turned, SymmetricInverse(body.inertia_shape, body.inertia_scale), Triple(momentum), turning_step)
                .vector();
        if (settings.large_strain) body.orientation = quaternion_of(turned);
    } else {
        w.setZero();
    }
    // The same account for rotation, component by component of the mean spin.
    const Lanes spin = lanes(w), momentum_after = lanes(momentum);
    sums.add_power(lanes(body.moment), spin_before, spin);
    const Lanes mean = 0.5 * (spin_before + spin), held = prescribed(fixed / fix_rx);
    const Lanes rest = (momentum_after - momentum_before - moment * kick) * mean;
    sums.boundary += torque * mean * kick + held * rest;
    if (has_arms && settings.large_strain) {
        sums.boundary[0] += work_on_arms(arms, (2 * kick - step) * spin_then, step * w);
        sums.inner_power_gain[0] += turning.dot(w - spin_then); // work on a displacement, as that of joints
    } else if (has_arms) {
        sums.boundary[0] += 0.5 * kick * turning.dot(spin_then + w);
    }
    sums.damped -= (1 - held) * rest;
    sums.kinetic_before += 0.5 * spin_before * momentum_before;
    sums.kinetic += 0.5 * spin * momentum_after;
}

/// One rigid block, one step.
void move_block(Model& model, std::size_t b, const DampingFactors& damping, MotionLanes& sums) {
    auto& blocks = model.blocks;
    if (blocks.fixed[b] == fix_all && blocks.velocity[b].isZero(0) && blocks.rotational_velocity[b].isZero(0)) return;
    const double mass = blocks.inertial_mass[b], step = model.clock.time_step;
    const Roller& roller = roller_of(model, static_cast<Row>(b));
    advance({blocks.mass[b], mass, blocks.inertia[b], mass / blocks.volume[b], blocks.fixed[b], blocks.force[b],
             blocks.load[b], blocks.moment[b], blocks.torque[b], blocks.load_arms[b], blocks.velocity[b],
             blocks.rotational_velocity[b], blocks.angular_momentum[b], blocks.last_force[b], blocks.last_moment[b],
             blocks.orientation[b], roller.count == 0 ? nullptr : &roller},
            model.settings, model.clock, damping, sums);
    const Vec3 shift = blocks.velocity[b] * step;
    blocks.displacement[b] += shift;
    if (!model.settings.large_strain) return displace_vertices(model, b);
    blocks.centroid[b] += shift;
    blocks.travelled[b] += place_vertices(model, b);
}

/// One step of joined blocks. The state of the body is that of its members, so nothing is stored twice: centroid and velocity are means by
/// mass, axes those of its first block.
void move_body(Model& model, std::span<const Row> members, const DampingFactors& damping, MotionLanes& sums) {
    auto& blocks = model.blocks;
    const BodyMass body = body_mass(model, members);
    const Row first = members.front();
    Vec3 velocity = Vec3::Zero(), spin = blocks.rotational_velocity[first];
    Vec3 force = Vec3::Zero(), load = Vec3::Zero(), moment = Vec3::Zero(), torque = Vec3::Zero();
    Mat3 arms = Mat3::Zero();
    bool rests = true;
    for (const Row b : members) {
        rests = rests && blocks.velocity[b].isZero(0) && blocks.rotational_velocity[b].isZero(0);
        velocity += blocks.mass[b] / body.mass * blocks.velocity[b];
        const Vec3 arm = blocks.centroid[b] - body.centroid;
        force += blocks.force[b];
        load += blocks.load[b];
        moment += blocks.moment[b] + arm.cross(blocks.force[b]);
        torque += blocks.torque[b];
        if (!blocks.load[b].isZero(0)) arms += arm * blocks.load[b].transpose();
        if (!blocks.load_arms[b].isZero(0)) arms += arms_now(model, b);
    }
    const std::uint8_t fixed = keep_held(blocks, members, velocity, spin);
    if (fixed == fix_all && rests) return;

    const Roller roller = roller_of_body(model, members);
    const Quaternion before = blocks.orientation[first];
    const Mat3 axes = quaternion(before).toRotationMatrix();
    Quaternion after = before;
    const double step = model.clock.time_step;
    // Density scaling gives all members the same factor.
    const double factor = blocks.mass[first] > 0 ? blocks.inertial_mass[first] / blocks.mass[first] : 1;
    const Mat3 inertia = axes.transpose() * body.inertia * axes, own_arms = axes.transpose() * arms;
    advance({body.mass, factor * body.mass, inertia, factor, fixed, force, load, moment, torque, own_arms, velocity,
             spin, blocks.angular_momentum[first], blocks.last_force[first], blocks.last_moment[first], after,
             roller.count == 0 ? nullptr : &roller},
            model.settings, model.clock, damping, sums);
    const Rotor turn = rotor(after) * rotor(before).conjugate();
    for (const Row b : members) {
        const Vec3 arm = blocks.centroid[b] - body.centroid, arm_after = turn.turned(Triple(arm)).vector();
        blocks.velocity[b] = velocity + spin.cross(arm_after);
        blocks.rotational_velocity[b] = spin;
        if (!model.settings.large_strain) {
            blocks.displacement[b] += blocks.velocity[b] * step;
            displace_vertices(model, static_cast<std::size_t>(b));
            continue;
        }
        const Vec3 shift = velocity * step + (arm_after - arm);
        blocks.displacement[b] += shift;
        blocks.centroid[b] += shift;
        if (b == first) {
            blocks.orientation[b] = after;
        } else {
            blocks.orientation[b] = quaternion_of(turn * rotor(blocks.orientation[b])).normalized();
        }
        blocks.travelled[b] += place_vertices(model, static_cast<std::size_t>(b));
    }
}

} // namespace

MotionSums move_blocks(Model& model, const JoinedBodies& bodies) {
    const auto& blocks = model.blocks;
    const DampingFactors damping(model.settings, model.clock);
    MotionSums of_bodies = reduce_chunks(
        bodies.size(), grain, MotionSums{},
        [&](std::size_t first, std::size_t last) {
            MotionLanes sums;
            for (std::size_t i = first; i < last; ++i) move_body(model, bodies.members(i), damping, sums);
            return sums.sums();
        },
        combine);
    return reduce_chunks(
        blocks.size(), grain, of_bodies,
        [&](std::size_t first, std::size_t last) {
            MotionLanes sums;
            PlainBlocks plain(model);
            for (std::size_t b = first; b < last; ++b) {
                if (plain.possible() && last - b >= eight && plain.are(b)) {
                    plain.move(b);
                    for (const std::size_t end = b + eight; b < end; ++b)
                        model.blocks.travelled[b] += place_vertices(model, b);
                    --b;
                } else if (!blocks.deformable[b] && blocks.body[b] == 0) {
                    move_block(model, b, damping, sums);
                }
            }
            MotionSums both = sums.sums();
            both.add(plain.sums());
            return both;
        },
        combine);
}

} // namespace kaya
