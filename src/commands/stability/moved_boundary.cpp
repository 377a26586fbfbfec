#include "commands/stability/moved_boundary.hpp"

#include "base/diagnostic.hpp"
#include "commands/list/reactions.hpp"
#include "commands/stability/scaled_histories.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/measure.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace kaya {

namespace {

/// Velocities for a variable of 1: three of translation, and three of the rotation of a rigid block.
using Motion = std::array<double, BoundaryHistories::motions>;

double along(const Motion& motion) { return std::hypot(motion[0], motion[1], motion[2]); }
double about(const Motion& motion) { return std::hypot(motion[3], motion[4], motion[5]); }

/// The moment that holds the rotation of a rigid body about its centroid; without the components that are free.
Vec3 holding_moment(const Model& model, std::span<const Row> members, const Vec3& centroid) {
    const auto& blocks = model.blocks;
    Vec3 moment = Vec3::Zero();
    unsigned fixed = 0;
    for (const Row b : members) {
        fixed |= blocks.fixed[b];
        moment -= blocks.moment[b] + load_moment(model, b) +
                  (blocks.centroid[b] - centroid).cross(unbalanced_force(model, b));
    }
    for (int k = 0; k < 3; ++k)
        if (!(fixed & (fix_rx << k))) moment[k] = 0;
    return moment;
}

/// Work per time of the supports of a rigid body.
double power_on(const Model& model, std::span<const Row> members) {
    const auto& blocks = model.blocks;
    const BodyMass body = body_mass(model, members);
    Vec3 velocity = Vec3::Zero();
    for (const Row b : members) velocity += blocks.mass[b] / body.mass * blocks.velocity[b];
    return reaction_on(model, members).dot(velocity) +
           holding_moment(model, members, body.centroid).dot(blocks.rotational_velocity[members.front()]);
}

/// Bodies that the histories move, with their motions.
struct Moved {
    std::map<Row, Motion> blocks;     ///< rigid
    std::map<Row, Motion> gridpoints; ///< of zones
};

Moved moved_by(const Model& model, const std::string& variable) {
    const auto& histories = model.boundary_histories;
    Moved moved;
    for (const Row i : scaled_histories(model, variable).rows) {
        const Row b = model.blocks.ids.row(histories.block[i]);
        const auto component = static_cast<std::size_t>(histories.component[i]);
        const Span points = model.blocks.gridpoints[b];
        const auto move = [&](std::map<Row, Motion>& bodies, Row row, unsigned fixed) {
            if (fixed & (1U << component)) bodies.try_emplace(row).first->second[component] = histories.amplitude[i];
        };
        const auto move_gridpoint = [&](Row g) { move(moved.gridpoints, g, model.gridpoints.fixed[g]); };
        if (histories.gridpoint[i] != no_row) move_gridpoint(points.first + histories.gridpoint[i]);
        else if (!model.blocks.deformable[b]) move(moved.blocks, b, model.blocks.fixed[b]);
        else
            for (Row g = points.first; g < points.end(); ++g) move_gridpoint(g);
    }
    return moved;
}

/// Joined blocks move by the first one that is held in a direction. Throws Diagnostic when that one is not driven like `block`.
void check_motion(const Model& model, const Moved& moved, Row block, std::span<const Row> members) {
    for (int k = 0; k < BoundaryHistories::motions; ++k) {
        const auto speed = [&](Row b) {
            const auto found = moved.blocks.find(b);
            return found == moved.blocks.end() ? 0 : found->second[static_cast<std::size_t>(k)];
        };
        const auto first =
            std::ranges::find_if(members, [&](Row b) { return (model.blocks.fixed[b] & (1 << k)) != 0; });
        if (first != members.end() && speed(*first) != speed(block))
            throw Diagnostic(fmt::format("block {} is driven, and block {}, to which it is joined, is held otherwise",
                                         model.blocks.number[block], model.blocks.number[*first]),
                             "drive all blocks that are joined alike");
    }
}

} // namespace

MovedBoundary::MovedBoundary(Session& session, const lang::SolveControl& command)
    : session_(session), model_(session.engine.model), variable_(command.variable) {
    renew();
}

bool MovedBoundary::is_outdated() const {
    return model_.blocks.size() != blocks_ || model_.gridpoints.size() != all_gridpoints_;
}

void MovedBoundary::renew() {
    if (!is_outdated()) return;
    blocks_ = model_.blocks.size();
    all_gridpoints_ = model_.gridpoints.size();
    const Moved moved = moved_by(model_, variable_);
    bodies_.clear();
    gridpoints_.clear();
    double along_most = 0, about_most = 0;
    std::map<Row, std::vector<Row>> joined;
    const JoinedBodies parts = joined_bodies(model_);
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (const Row b : parts.members(i)) joined[b].assign(parts.members(i).begin(), parts.members(i).end());
    for (const auto& [b, motion] : moved.blocks) {
        const std::vector<Row> members = joined.contains(b) ? joined.at(b) : std::vector{b};
        check_motion(model_, moved, b, members);
        along_most = std::max(along_most, along(motion));
        about_most = std::max(about_most, about(motion));
        if (std::ranges::find(bodies_, members) == bodies_.end()) bodies_.push_back(members);
    }
    for (const auto& [g, motion] : moved.gridpoints) {
        along_most = std::max(along_most, along(motion));
        gridpoints_.push_back(g);
    }
    turns_ = along_most == 0;
    size_ = turns_ ? about_most : along_most;
    if (!(size_ > 0))
        throw Diagnostic(fmt::format("'@{}' drives nothing: its velocities are 0, or no longer held", variable_),
                         fmt::format("give one, e.g. apply xvel 1 hist @{}", variable_));
}

double MovedBoundary::load() const {
    if (factor_ == 0) return 0;
    double power = 0;
    for (const auto& members : bodies_) power += power_on(model_, members);
    for (const Row g : gridpoints_) power += reaction_on_gridpoint(model_, g).dot(Vec3(model_.gridpoints.velocity[g]));
    return power / velocity();
}

Vec3 MovedBoundary::reaction() const {
    Vec3 others = reactions_of(model_, [](Row) { return false; }).reaction;
    for (const auto& members : bodies_) others -= reaction_on(model_, members);
    for (const Row g : gridpoints_) others -= reaction_on_gridpoint(model_, g);
    return others;
}

void MovedBoundary::set(double factor) {
    factor_ = factor;
    session_.engine.scripts->set(variable_, factor);
}

void MovedBoundary::advance(double, double wanted) {
    constexpr double part = 0.2; // of what is missing: a jump would be an impact
    set(factor_ + part * (wanted / size_ - factor_));
}

void MovedBoundary::end() { set(0); }

} // namespace kaya
