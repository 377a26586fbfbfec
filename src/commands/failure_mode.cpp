#include "commands/failure_mode.hpp"

#include "base/counted.hpp"
#include "commands/rest_monitor.hpp"
#include "commands/text_table.hpp"
#include "mechanics/cycle.hpp"
#include "model/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {

namespace {

constexpr double toppling = 0.25;               ///< of the motion across joints, by turning
constexpr double some = 0.25, nearly_all = 0.9; ///< of the work that is lost, in zones

double lost_in_joints(const Model& model) { return model.energy.joint_friction + model.energy.joint_lost; }
double lost_in_zones(const Model& model, const Cycle& cycle) {
    return model.energy.zone_work - cycle.energy_in_zones();
}

Eigen::Quaterniond as_rotation(const Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }

const char* name_of(const FailureMode::Shares& shares) {
    if (!shares.joints_move || shares.zones > nearly_all) return "yield of zones";
    if (shares.zones > some) return shares.topples() ? "toppling with yield of zones" : "sliding with yield of zones";
    return shares.topples() ? "toppling" : "sliding";
}

} // namespace

bool FailureMode::Shares::topples() const { return turning > toppling; }

FailureMode::FailureMode(const Model& model, const Cycle& cycle)
    : joint_loss_(lost_in_joints(model)), zone_loss_(lost_in_zones(model, cycle)) {
    for (std::size_t c = 0; c < model.contacts.size(); ++c)
        joints_.push_back(
            {model.contacts.block1[c], model.contacts.block2[c], model.contacts.position[c], model.contacts.area[c]});
    const auto& points = model.gridpoints;
    for (std::size_t g = 0; g < points.size(); ++g)
        positions_.push_back(points.position[g]), displacements_.push_back(points.displacement[g]);
    for (Row b = 0; b < static_cast<Row>(model.blocks.size()); ++b) {
        centroids_.push_back(model.blocks.centroid[b]);
        block_displacements_.push_back(block_displacement(model, b));
        orientations_.push_back(model.blocks.orientation[b]);
    }
}

FailureMode::Motion FailureMode::motion(const Model& model, Row block) const {
    const auto b = static_cast<std::size_t>(block);
    Motion found;
    if (!model.blocks.deformable[block]) {
        found.centre = centroids_[b];
        found.shift = block_displacement(model, block) - block_displacements_[b];
        const Eigen::AngleAxisd turn(as_rotation(model.blocks.orientation[block]) *
                                     as_rotation(orientations_[b]).conjugate());
        const double angle = turn.angle() > std::numbers::pi ? turn.angle() - 2 * std::numbers::pi : turn.angle();
        found.turn = angle * turn.axis();
        return found;
    }
    // The rigid motion with the momentum and the angular momentum of its gridpoints.
    const Span span = model.blocks.gridpoints[block];
    double mass = 0;
    const auto shift = [&](std::size_t g) -> Vec3 { return model.gridpoints.displacement[g] - displacements_[g]; };
    for (auto g = static_cast<std::size_t>(span.first); g < static_cast<std::size_t>(span.end()); ++g) {
        const double m = model.gridpoints.mass[g];
        mass += m, found.centre += m * positions_[g], found.shift += m * shift(g);
    }
    if (!(mass > 0)) return found;
    found.centre /= mass, found.shift /= mass;
    Mat3 inertia = Mat3::Zero();
    Vec3 momentum = Vec3::Zero();
    for (auto g = static_cast<std::size_t>(span.first); g < static_cast<std::size_t>(span.end()); ++g) {
        const double m = model.gridpoints.mass[g];
        const Vec3 arm = positions_[g] - found.centre;
        inertia += m * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
        momentum += m * arm.cross(shift(g) - found.shift);
    }
    found.turn = inertia.ldlt().solve(momentum);
    return found;
}

FailureMode::Shares FailureMode::shares(const Model& model, const Cycle& cycle) const {
    std::vector<Motion> motions;
    for (Row b = 0; b < static_cast<Row>(model.blocks.size()); ++b) motions.push_back(motion(model, b));
    double all = 0, turning = 0;
    for (const Joint& joint : joints_) {
        const Motion &one = motions[static_cast<std::size_t>(joint.block1)],
                     &two = motions[static_cast<std::size_t>(joint.block2)];
        const Vec3 by_shift = two.shift - one.shift,
                   by_turn = two.turn.cross(joint.position - two.centre) - one.turn.cross(joint.position - one.centre);
        // Blocks that turn together as one body do not move across their joint, though both parts are there.
        const double weight = joint.area * (by_shift + by_turn).norm(), sum = by_shift.norm() + by_turn.norm();
        if (!(sum > 0)) continue;
        all += weight;
        turning += weight * by_turn.norm() / sum;
    }
    Shares shares;
    shares.joints_move = all > 0;
    shares.turning = all > 0 ? turning / all : 0;
    const double in_joints = std::max(0.0, lost_in_joints(model) - joint_loss_),
                 zones = std::max(0.0, lost_in_zones(model, cycle) - zone_loss_);
    shares.zones = in_joints + zones > 0 ? zones / (in_joints + zones) : 0;
    return shares;
}

std::string mode_text(const FailureMode::Shares& shares) {
    return fmt::format(
        "mode of failure: {}; {:.0f} % of the motion across joints is turning of blocks, {:.0f} % of the "
        "work that is lost is lost in zones",
        name_of(shares), 100 * shares.turning, 100 * shares.zones);
}

std::string farthest_text(const Model& start, const Model& model, double factor) {
    constexpr double much = 0.1;
    double farthest = 0;
    Row first = no_row;
    std::vector<double> shifts;
    for (Row b = 0; b < static_cast<Row>(model.blocks.size()); ++b) {
        shifts.push_back((block_displacement(model, b) - block_displacement(start, b)).norm());
        if (shifts.back() > farthest) farthest = shifts.back(), first = b;
    }
    if (first == no_row) return {};
    const auto moved = std::ranges::count_if(shifts, [&](double shift) { return shift > much * farthest; });
    return fmt::format("at {:.6g} {} moved most, by {} when the trial ended; {} of {} went a tenth of that or more",
                       factor, body_text(model, MovingBody{first}), number_text(farthest), moved,
                       counted(static_cast<std::int64_t>(shifts.size()), "block"));
}

} // namespace kaya
