#include "commands/stability/failure_mode.hpp"

#include "base/counted.hpp"
#include "commands/monitors/rest_monitor.hpp"
#include "commands/program/text_table.hpp"
#include "mechanics/cycle/cycle.hpp"
#include "model/measure/cell_corners.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

constexpr double toppling = 0.25;               ///< of the motion across joints, by turning
constexpr double some = 0.25, nearly_all = 0.9; ///< of the work that is lost, in zones

/// Of numbers.
struct Reach {
    double low = INFINITY, high = -INFINITY;
    void add(double x) { low = std::min(low, x), high = std::max(high, x); }
    double size() const { return high - low; }
};

double lost_in_joints(const Model& model) { return model.energy.joint_friction + model.energy.joint_lost; }
double lost_in_zones(const Model& model, const Cycle& cycle) {
    return model.energy.zone_work - cycle.energy_in_zones();
}

std::string name_of(const FailureMode::Shares& shares) {
    if (!shares.joints_move || shares.zones > nearly_all) return "yield of zones";
    std::string name = !shares.topples() ? "sliding" : shares.backward ? "backward toppling" : "toppling";
    if (shares.zones > some) name += " with yield of zones";
    return name;
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
}

Vec3 FailureMode::shift(const Model& model, std::size_t gridpoint) const {
    return model.gridpoints.displacement[gridpoint] - displacements_[gridpoint];
}

FailureMode::Motion FailureMode::motion(const Model& model, Row block) const {
    // Corners of a rigid block move also in small strain, where its orientation is fixed; each has equal weight.
    const Span span = model.blocks.gridpoints[block];
    const auto first = static_cast<std::size_t>(span.first), end = static_cast<std::size_t>(span.end());
    const auto mass = [&](std::size_t g) { return model.blocks.deformable[block] ? model.gridpoints.mass[g] : 1.0; };
    Motion found;
    double all = 0;
    for (std::size_t g = first; g < end; ++g) {
        all += mass(g);
        found.centre += mass(g) * (positions_[g] - positions_[first]), found.shift += mass(g) * shift(model, g);
    }
    if (!(all > 0)) return {};
    found.centre = positions_[first] + found.centre / all, found.shift /= all;
    Mat3 inertia = Mat3::Zero();
    Vec3 momentum = Vec3::Zero();
    for (std::size_t g = first; g < end; ++g) {
        const Vec3 arm = positions_[g] - found.centre;
        inertia += mass(g) * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
        momentum += mass(g) * arm.cross(shift(model, g) - found.shift);
    }
    found.turn = inertia.ldlt().solve(momentum);
    return found;
}

/// Whether blocks rotate against the sense of toppling in the direction of the mean shift; false without gravity, or for vertical motion.
bool FailureMode::turns_backward(const Model& model, const std::vector<Motion>& motions) {
    Vec3 shift = Vec3::Zero(), turn = Vec3::Zero();
    for (std::size_t b = 0; b < motions.size(); ++b)
        shift += model.blocks.mass[b] * motions[b].shift, turn += model.blocks.mass[b] * motions[b].turn;
    return model.settings.gravity.cross(shift).dot(turn) > 0;
}

/// The motion of what moves: its mean over the volume, weighted with the motion itself. Loose zones at a surface, which go farthest, count by
/// their volume, and zones at rest do not.
double FailureMode::typical_shift(const Model& model) const {
    double sum = 0, squares = 0;
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        Vec3 mean = Vec3::Zero();
        for (const Row g : model.zones.gridpoints[z]) mean += 0.25 * shift(model, static_cast<std::size_t>(g));
        sum += model.zones.volume[z] * mean.norm();
        squares += model.zones.volume[z] * mean.squaredNorm();
    }
    return sum > 0 ? squares / sum : 0;
}

void FailureMode::count_zones(const Model& model, Shares& shares) const {
    const double far = typical_shift(model) / 3;
    const auto distance = [&](Row g) { return shift(model, static_cast<std::size_t>(g)).norm(); };
    const Vec3& gravity = model.settings.gravity;
    const Vec3 up = gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3(0, 0, 1);
    Reach whole;
    double sizes = 0;
    std::int64_t count = 0, cells = 0;
    for (Row z = 0; z < static_cast<Row>(model.zones.size()); ++z) {
        const auto& corners = model.zones.gridpoints[z];
        if (std::ranges::any_of(corners, [&](Row g) { return distance(g) < far; })) continue;
        // The four corners of a zone of a cell include two opposite ones of the cell.
        Reach own;
        double edges = 0;
        for (std::size_t a = 0; a < 4; ++a) {
            const Vec3& x = positions_[static_cast<std::size_t>(corners[a])];
            own.add(up.dot(x)), whole.add(up.dot(x));
            for (std::size_t b = 0; b < a; ++b)
                edges += (x - positions_[static_cast<std::size_t>(corners[b])]).norm() / 6;
        }
        const bool in_cell = model.blocks.cell_zones[model.zones.block[z]] == zones_of_cell;
        sizes += in_cell ? own.size() : edges;
        ++count, cells += in_cell;
    }
    if (count == 0 || !(sizes > 0)) return;
    shares.zones_high = whole.size() / (sizes / static_cast<double>(count));
    shares.in_cells = 2 * cells > count;
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
        // Blocks that rotate together as one body have no relative motion across their joint, though both parts are nonzero.
        const double weight = joint.area * (by_shift + by_turn).norm(), sum = by_shift.norm() + by_turn.norm();
        if (!(sum > 0)) continue;
        all += weight;
        turning += weight * by_turn.norm() / sum;
    }
    Shares shares;
    shares.joints_move = all > 0;
    shares.turning = all > 0 ? turning / all : 0;
    shares.backward = turns_backward(model, motions);
    const double in_joints = std::max(0.0, lost_in_joints(model) - joint_loss_),
                 zones = std::max(0.0, lost_in_zones(model, cycle) - zone_loss_);
    // Zones without cohesion that dilate as much as they have friction lose no work.
    shares.zones = !shares.joints_move ? 1 : in_joints + zones > 0 ? zones / (in_joints + zones) : 0;
    if (shares.zones > some) count_zones(model, shares);
    return shares;
}

std::string mode_text(const FailureMode::Shares& shares) {
    return fmt::format(
        "mode of failure: {}; {:.0f} % of the motion across joints is turning of blocks, {:.0f} % of the "
        "work that is lost is lost in zones",
        name_of(shares), 100 * shares.turning, 100 * shares.zones);
}

std::string mesh_text(const FailureMode::Shares& shares, FineZones fine) {
    // Errors of slopes times the number of zones over their height: docs/theory/slopes.md, "Mesh refinement".
    struct Errors {
        double low, high;
    };
    const Errors errors = shares.in_cells ? Errors{0.15, 0.8} : Errors{0.6, 1.8};
    if (shares.zones_high < fewest_zones) return {};
    constexpr std::array advice{": try a finer mesh too", ": try a finer mesh too, or solve fos extrapolate", ""};
    return fmt::format(
        "mesh: {:.1f} {} over the height of the zones that moved; a band of slip is as wide as a zone, so slopes get factors {:.0f} to {:.0f} % too high{}",
        shares.zones_high, shares.in_cells ? "cells" : "tetrahedra", 100 * errors.low / shares.zones_high,
        100 * errors.high / shares.zones_high, advice[static_cast<std::size_t>(fine)]);
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
