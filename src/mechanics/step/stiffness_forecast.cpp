#include "mechanics/step/stiffness_forecast.hpp"

#include "mechanics/contact/contact_kind.hpp"
#include "mechanics/supports/held_directions.hpp"
#include "mechanics/contact/overlap_contact.hpp"
#include "mechanics/contact/row_copy.hpp"
#include "mechanics/shape/overlap_gap.hpp"
#include "base/parallel.hpp"
#include "model/measure/held.hpp"
#include "model/measure/roller.hpp"
#include "model/measure/turn.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

/// Steps ahead: the stiffness must be stable when it is reached, and close to that when it is left.
constexpr double steps_ahead = 2;
/// A normal force that grows by at most this part changes the stiffness of any joint law only a little.
constexpr double small_growth = 0.25;
/// A displacement that a law refuses counts as one that makes it so many times as stiff.
constexpr double refused = 1e6;
/// The part of the stable step that is taken leaves room for a stiffness that grows so many times.
constexpr double harmless = 1.25;
/// Stiffnesses that differ by less than this part are the same.
constexpr double same = 1e-9;

/// Whether the stiffness of a joint that has carried nothing depends on how far it is closed.
bool varies(const JointModel& joint, const std::vector<double>& values) {
    if (!joint.missing(values).empty()) return false;
    RowCopy copy;
    copy.normal_disp = 1; // one that is apart may report another
    auto batch = copy.batch(joint, values, 1);
    if (initialise_batch(joint, batch)) return true;
    const Springs apart{copy.normal_stiffness, copy.shear_stiffness};
    copy = RowCopy{};
    batch = copy.batch(joint, values, 1);
    if (initialise_batch(joint, batch)) return true;
    const auto differs = [](double a, double b) { return std::abs(a - b) > same * std::max(a, b); };
    const auto changed = [&] {
        return differs(copy.normal_stiffness, apart.normal) || differs(copy.shear_stiffness, apart.shear);
    };
    // In the deck's length, for any unit.
    for (double closure = 1e-15; closure < 1e3; closure *= 10) {
        if (changed()) return true;
        copy.normal_disp_inc = -closure;
        if (run_batch(joint, batch)) return true;
        copy.normal_disp += copy.normal_disp_inc;
    }
    return changed();
}

/// The direction of an offset is at most this oblique to the normal of its contact.
constexpr double least_cosine = 0.1;

/// The thickness of a block along a direction.
double thickness(const Model& model, Row block, const Vec3& n) {
    const Vec3& origin = model.blocks.centroid[block]; // numbers stay small
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const Span span = model.blocks.gridpoints[block];
    for (Row g = span.first; g < span.end(); ++g) {
        const double along = n.dot(model.gridpoints.position[g] - origin);
        low = std::min(low, along);
        high = std::max(high, along);
    }
    return high - low;
}

/// The offset of an overlap contact, along its normal where no direction is stored.
ClosureOffset offset_of_contact(const Contacts& contacts, Row c) {
    ClosureOffset offset = offset_of(contacts, c);
    if (offset.along.isZero(0)) offset.along = contacts.normal[c];
    return offset;
}

} // namespace

void StiffnessForecast::take(const Model& model, std::vector<Batch>& batches) {
    varying_.clear();
    in_varying_.assign(model.contacts.size(), 0);
    for (Batch& batch : batches) {
        auto found = varies_.find(batch.properties);
        if (found == varies_.end())
            found =
                varies_.emplace(batch.properties, varies(*batch.model, model.joint_properties[batch.properties].values))
                    .first;
        batch.curved = found->second;
        if (!batch.curved) continue;
        varying_.push_back(batch);
        for (const Row c : batch.contacts) in_varying_[c] = 1;
    }
}

/// Velocities of rigid blocks after the present forces have acted for a step.
void StiffnessForecast::find_motions(const Model& model, const Adjacency& adjacency, double step) {
    const auto& blocks = model.blocks;
    motions_.resize(blocks.size());
    const auto advance = [&](const Vec3& centre, double mass, double inertial, const Mat3& inertia, unsigned fixed,
                             const Roller& roller, Row b, const Vec3& velocity, const Vec3& force, const Vec3& moment) {
        Motion motion{centre, velocity, blocks.rotational_velocity[b]};
        if (inertial > 0) {
            motion.velocity += free_part(step / inertial * (force + mass * model.settings.gravity), fixed);
            motion.spin += free_part(step * inertia.inverse() * moment, fixed / fix_rx);
            if (roller.count != 0)
                motion.velocity +=
                    roller_change(roller, motion.velocity, static_cast<std::uint8_t>(fixed), roller.speed);
        }
        return motion;
    };
    for_chunks(blocks.size(), 512, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Row b = static_cast<Row>(i);
            if (blocks.deformable[b] || blocks.body[b] != 0) continue;
            const Mat3 turn = turn_of(blocks, b);
            const double inertial = blocks.inertial_mass[b];
            motions_[b] = advance(blocks.centroid[b], blocks.mass[b], inertial,
                                  inertial / blocks.volume[b] * (turn * blocks.inertia[b] * turn.transpose()),
                                  blocks.fixed[b], roller_of(model, b), b, blocks.velocity[b],
                                  blocks.force[b] + blocks.load[b], blocks.moment[b] + blocks.torque[b]);
        }
    });
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i) {
        const auto members = adjacency.bodies.members(i);
        const BodyMass body = body_mass(model, members);
        const Row lead = members.front();
        Vec3 force = Vec3::Zero(), moment = force, velocity = force;
        unsigned fixed = 0;
        for (const Row b : members) {
            const Vec3 acting = blocks.force[b] + blocks.load[b];
            force += acting;
            moment += blocks.moment[b] + blocks.torque[b] + (blocks.centroid[b] - body.centroid).cross(acting);
            fixed |= blocks.fixed[b];
        }
        velocity =
            blocks.velocity[lead] + blocks.rotational_velocity[lead].cross(body.centroid - blocks.centroid[lead]);
        const double factor = blocks.mass[lead] > 0 ? blocks.inertial_mass[lead] / blocks.mass[lead] : 0;
        const Motion motion = advance(body.centroid, body.mass, factor * body.mass, factor * body.inertia, fixed,
                                      roller_of_body(model, members), lead, velocity, force, moment);
        for (const Row b : members) motions_[b] = motion;
    }
}

Vec3 StiffnessForecast::velocity_of_side(const Model& model, Row block, const Attachment& side, const Vec3& place,
                                         double step) const {
    if (!model.blocks.deformable[block]) {
        const Motion& motion = motions_[block];
        return motion.velocity + motion.spin.cross(place - motion.centre);
    }
    const auto& g = model.gridpoints;
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
        const Row p = side.gridpoints[k];
        if (side.weights[k] == 0) continue;
        Vec3 velocity = g.velocity[p];
        if (g.inertial_mass[p] > 0)
            velocity += free_part(
                step / g.inertial_mass[p] * (g.force[p] + g.load[p] + g.mass[p] * model.settings.gravity), g.fixed[p]);
        sum += side.weights[k] * velocity;
    }
    return sum;
}

bool StiffnessForecast::check(const Model& model, const Batch& batch, Row c, double step) {
    RowCopy copy;
    const auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    const Span span = contacts.sub_contacts[c];
    const NormalAreaFactor factor(model, c);
    const bool overlap = follows_overlap(model, c);
    const double gap = overlap ? gap_of_overlap(model, c) : 0;
    // The place of an overlap is not that where the blocks will meet, and other corners may come first.
    const double approach = !overlap                             ? 0
                            : gap == 0 && contacts.depth[c] == 0 ? farthest_motion(model, c, steps_ahead * step)
                                                                 : closing_within(model, c, steps_ahead * step);
    bool grows = false;
    for (Row s = span.first; s < span.end(); ++s) {
        Springs& springs = springs_[s];
        springs = springs_of(subs, s, factor);
        if (overlap ? s >= span.first + carriers : !subs.side1[s].attached() || !subs.side2[s].attached()) continue;
        const Vec3 place = subs.position[s];
        const double opening =
            contacts.normal[c].dot(velocity_of_side(model, contacts.block2[c], subs.side2[s], place, step) -
                                   velocity_of_side(model, contacts.block1[c], subs.side1[s], place, step));
        const double closure = std::max(approach, -opening * step * steps_ahead) - gap, force = subs.normal_force[s];
        if (closure <= 0 || springs.normal * closure <= small_growth * force) continue;
        // Where blocks are apart a joint knows the present gap, an overlap that of its beginning.
        const double left = overlap ? std::max(0.0, subs.normal_displacement[s]) : 0;
        if (force == 0 && !overlap && closure <= subs.normal_displacement[s]) continue; // still apart
        copy.take(model, *batch.model, s);
        copy.normal_disp_inc = -closure - left;
        auto columns = copy.batch(*batch.model, model.joint_properties[batch.properties].values, step);
        const bool failed = run_batch(*batch.model, columns).has_value();
        const double normal = failed ? refused * springs.normal : copy.normal_stiffness * copy.area * factor.of(s);
        const double shear = failed ? springs.shear : copy.shear_stiffness * copy.area * factor.of(s);
        if (normal <= harmless * springs.normal && shear <= harmless * springs.shear) continue;
        springs = {std::max(springs.normal, normal), std::max(springs.shear, shear)};
        grows = true;
    }
    return grows;
}

/// How far the blocks of an overlap contact may have moved into each other after a time, beyond their present overlap; 0 if they are apart
/// then. Their support along the normal is that of the moved blocks, rotations included.
double StiffnessForecast::closing_of(const Model& model, Row c, double time) const {
    const auto& contacts = model.contacts;
    const Vec3& n = contacts.normal[c];
    const Row b1 = contacts.block1[c], b2 = contacts.block2[c];
    const Vec3 origin = model.blocks.centroid[b1]; // numbers stay small
    const auto farthest = [&](Row b, const Vec3& direction, bool moved) {
        const Motion& motion = motions_[b];
        const double angle = motion.spin.norm() * time;
        const Mat3 turn = moved && angle > 0 ? Eigen::AngleAxisd(angle, motion.spin.normalized()).toRotationMatrix()
                                             : Mat3(Mat3::Identity());
        const Vec3 shift = moved ? Vec3(motion.velocity * time) : Vec3(Vec3::Zero());
        double most = -std::numeric_limits<double>::infinity();
        for (Row g = model.blocks.gridpoints[b].first; g < model.blocks.gridpoints[b].end(); ++g) {
            const Vec3 arm = model.gridpoints.position[g] - motion.centre;
            most = std::max(most, direction.dot(motion.centre - origin + turn * arm + shift));
        }
        return most;
    };
    const auto gap = [&](bool moved) { return -farthest(b1, n, moved) - farthest(b2, -n, moved); };
    const double now = gap(false), then = gap(true),
                 offset = now - gap_along(model, b1, b2, n, offset_of_contact(contacts, c));
    return then < offset ? std::max(0.0, now - then) : 0;
}

double StiffnessForecast::farthest_motion(const Model& model, Row c, double time) const {
    const auto& contacts = model.contacts;
    const auto turning = [&](Row b) {
        const Motion& motion = motions_[b];
        if (motion.spin.isZero(0)) return 0.0;
        double square = 0;
        for (Row g = model.blocks.gridpoints[b].first; g < model.blocks.gridpoints[b].end(); ++g)
            square = std::max(square, (model.gridpoints.position[g] - motion.centre).squaredNorm());
        return motion.spin.norm() * std::sqrt(square);
    };
    const Row b1 = contacts.block1[c], b2 = contacts.block2[c];
    return time * ((motions_[b2].velocity - motions_[b1].velocity).norm() + turning(b1) + turning(b2));
}

double StiffnessForecast::closing_within(const Model& model, Row c, double time) const {
    return std::max(closing_of(model, c, 0.5 * time), closing_of(model, c, time));
}

/// The factor by which an overlap may stiffen within the steps ahead: that of its area at the greatest depth which its blocks can reach. Where
/// a step would carry them through each other, that is where the thinner one is inside.
double StiffnessForecast::growth_of_overlap(const Model& model, Row c, double step, OverlapScratch& scratch) const {
    const auto& contacts = model.contacts;
    const double reached = closing_within(model, c, steps_ahead * step);
    const double area = std::max(contacts.stiffness_area[c], contacts.area[c]);
    if (!(reached > 0 && area > 0)) return 1;
    const Vec3& n = contacts.normal[c];
    const OverlapPair pair = pair_of(contacts, c);
    const double inside =
        gap_of_overlap(model, c) + std::min(thickness(model, pair.block1, n), thickness(model, pair.block2, n));
    ClosureOffset offset = offset_of_contact(contacts, c);
    offset.closure += std::min(reached, inside) / std::max(least_cosine, offset.along.dot(n));
    const double carrying = overlap_patch(model, pair, n, offset, scratch).carrying_area(0);
    return std::max(overlap_area(model, pair, n, offset, scratch), carrying) / area;
}

bool StiffnessForecast::update(const Model& model, const Adjacency& adjacency, double step, Of of) {
    find_motions(model, adjacency, step);
    springs_.resize(model.sub_contacts.size());
    marks_.assign(model.contacts.size(), 0);
    for_chunks(varying_.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (const Row c : varying_[i].contacts) marks_[c] = check(model, varying_[i], c, step);
    });
    growth_.assign(model.contacts.size(), 1);
    if (of == Of::laws_and_overlaps)
        for_chunks(growth_.size(), 64, [&](std::size_t first, std::size_t last) {
            OverlapScratch& scratch = scratch_.local();
            for (std::size_t i = first; i < last; ++i) {
                const Row c = static_cast<Row>(i);
                if (!follows_overlap(model, c)) continue;
                growth_[i] = growth_of_overlap(model, c, step, scratch);
                if (growth_[i] > harmless) marks_[i] = 1;
            }
        });
    if (std::find(marks_.begin(), marks_.end(), 1) == marks_.end()) return false;
    for (std::size_t c = 0; c < in_varying_.size(); ++c) {
        const NormalAreaFactor factor(model, static_cast<Row>(c));
        const Span span = model.contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s) {
            if (!in_varying_[c]) springs_[s] = springs_of(model.sub_contacts, s, factor);
            if (!(growth_[c] > 1) || s >= span.first + carriers) continue;
            springs_[s].normal *= growth_[c];
            springs_[s].shear *= growth_[c];
        }
    }
    return true;
}

} // namespace kaya
