#include "commands/stability/load_pattern.hpp"

#include "base/diagnostic.hpp"
#include "commands/stability/scaled_histories.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/held.hpp"

#include <map>

namespace kaya {

namespace {

constexpr unsigned translations(std::uint8_t fixed) { return fixed & 7U; }
constexpr unsigned rotations(std::uint8_t fixed) { return fixed >> 3U & 7U; }

} // namespace

LoadPattern::LoadPattern(const Model& model, const Vec3& gravity, const std::string& variable)
    : blocks_(model.blocks.size()), gridpoints_(model.gridpoints.size()) {
    if (!gravity.isZero()) add_gravity(model, gravity);
    if (!variable.empty()) add_loads(model, variable);
    double moments = 0;
    for (Part& part : parts_) {
        part.force = free_part(part.force, translations(part.block == no_row ? model.gridpoints.fixed[part.gridpoint]
                                                                             : model.blocks.fixed[part.block]));
        force_ += part.force.norm();
        moments += moment_now(model, part).norm();
    }
    turns_ = force_ == 0;
    if (turns_) force_ = moments;
    if (!(force_ > 0))
        throw Diagnostic("nothing that is free carries the loads that are scaled",
                         "free the blocks that are pushed, or load others");
}

bool LoadPattern::is_of(const Model& model) const {
    return model.blocks.size() == blocks_ && model.gridpoints.size() == gridpoints_;
}

LoadPattern::Part& LoadPattern::part_of(Row block, Row gridpoint) {
    const auto [found, added] = places_.try_emplace({block, gridpoint}, parts_.size());
    if (added) parts_.push_back({.block = block, .gridpoint = gridpoint});
    return parts_[found->second];
}

void LoadPattern::add_gravity(const Model& model, const Vec3& gravity) {
    const auto& blocks = model.blocks;
    const auto add = [&](Row block, Row gridpoint, double mass) { part_of(block, gridpoint).force = mass * gravity; };
    for (Row b = 0; static_cast<std::size_t>(b) < blocks.size(); ++b) {
        const Span points = blocks.gridpoints[b];
        if (blocks.deformable[b]) {
            for (Row g = points.first; g < points.end(); ++g)
                if (translations(model.gridpoints.fixed[g]) != 7U) add(no_row, g, model.gridpoints.mass[g]);
        } else if (translations(blocks.fixed[b]) != 7U) add(b, no_row, blocks.mass[b]);
    }
}

void LoadPattern::add_loads(const Model& model, const std::string& variable) {
    const auto& histories = model.boundary_histories;
    for (const Row i : scaled_histories(model, variable).rows) {
        const Row b = model.blocks.ids.row(histories.block[i]);
        const double amount = histories.amplitude[i];
        const int component = histories.component[i];
        if (histories.gridpoint[i] != no_row) {
            part_of(no_row, model.blocks.gridpoints[b].first + histories.gridpoint[i]).force[component] += amount;
            continue;
        }
        Part& part = part_of(b, no_row);
        const int place = component - BoundaryHistories::motions;
        if (component < 3) part.force[component] += amount;
        else if (component < BoundaryHistories::motions) part.moment[component - 3] += amount;
        else part.arms(place % 3, place / 3) += amount;
    }
}

Vec3 LoadPattern::moment_now(const Model& model, const Part& part) {
    if (part.block == no_row) return Vec3::Zero();
    return free_part(part.moment + moment_of(turn_of(model.blocks, part.block) * part.arms),
                     rotations(model.blocks.fixed[part.block]));
}

double LoadPattern::velocity(const Model& model) const {
    double power = 0;
    for (const Part& part : parts_)
        power += part.block == no_row ? part.force.dot(model.gridpoints.velocity[part.gridpoint])
                                      : part.force.dot(model.blocks.velocity[part.block]) +
                                            moment_now(model, part).dot(model.blocks.rotational_velocity[part.block]);
    return power / force_;
}

double LoadPattern::answer(const Model& model) const {
    struct Sum {
        std::vector<Row> rows;
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    };
    std::map<std::int32_t, Sum> bodies; // joined blocks move as one
    const auto& blocks = model.blocks;
    double power = 0;
    for (const Part& part : parts_) {
        if (part.block == no_row) {
            power += part.force.squaredNorm() / model.gridpoints.inertial_mass[part.gridpoint];
            continue;
        }
        if (blocks.body[part.block] != 0) {
            Sum& sum = bodies[blocks.body[part.block]];
            sum.force += part.force;
            sum.moment += moment_now(model, part) + blocks.centroid[part.block].cross(part.force);
            continue;
        }
        const Vec3 moment = moment_now(model, part);
        power += part.force.squaredNorm() / blocks.inertial_mass[part.block];
        if (!moment.isZero()) power += moment.dot(inertia_now(model, part.block).inverse() * moment);
    }
    for (Row b = 0; static_cast<std::size_t>(b) < blocks.size() && !bodies.empty(); ++b)
        if (const auto found = bodies.find(blocks.body[b]); found != bodies.end()) found->second.rows.push_back(b);
    for (const auto& [number, sum] : bodies) {
        const BodyMass body = body_mass(model, sum.rows);
        const Vec3 moment = sum.moment - body.centroid.cross(sum.force);
        power += sum.force.squaredNorm() / body.mass + moment.dot(body.inertia.inverse() * moment);
    }
    return power / force_;
}

} // namespace kaya
