#include "commands/monitors/rest_monitor.hpp"

#include "base/number_text.hpp"
#include "commands/program/text_table.hpp"
#include "model/measure/held.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/time_step_fraction.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

/// Number of marks kept; beyond it every second one is dropped and the stride doubles.
constexpr std::size_t most_marks = 8;
/// A body that keeps this part of its mean velocity from one span to the next does not slow down.
constexpr double kept_velocity = 0.9;
/// A body is at rest when its displacement is below this part of the elastic deformation of its springs under the forces on it.
constexpr double quiet_part = 0.1 / 16;
/// So is one that gains less than this part of its displacement since the run began: its springs still settle.
constexpr double settling_part = 0.02;

} // namespace

std::vector<double> acting_forces(const Model& model) {
    const auto& blocks = model.blocks;
    std::vector<double> acting(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b)
        acting[b] = block_load(model, static_cast<Row>(b)).norm() + blocks.mass[b] * model.settings.gravity.norm();
    for (std::size_t c = 0; c < model.contacts.size(); ++c) {
        Vec3 sum = Vec3::Zero(); // normal and shear apart
        const Span span = model.contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); ++s)
            sum += Vec3(std::abs(model.sub_contacts.normal_force[s]), model.sub_contacts.shear_force[s].norm(), 0);
        acting[model.contacts.block1[c]] += sum.norm();
        acting[model.contacts.block2[c]] += sum.norm();
    }
    return acting;
}

std::optional<MovingBody> fastest_body(const Model& model) {
    MovingBody fastest;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const double speed =
            is_held(model, static_cast<Row>(b)) ? 0 : block_velocity(model, static_cast<Row>(b)).norm();
        if (speed > fastest.speed) fastest = {static_cast<Row>(b), speed};
    }
    return fastest.block == no_row ? std::nullopt : std::optional(fastest);
}

std::string body_text(const Model& model, const MovingBody& body) {
    const Vec3 place = block_centroid(model, body.block);
    return fmt::format("block {} at {}", model.blocks.number[body.block], place_text(place));
}

RestMonitor::RestMonitor(const Model& model) : model_(model) { marks_.push_back(mark()); }

RestMonitor::Mark RestMonitor::mark() const {
    const auto& blocks = model_.blocks;
    Mark mark{model_.clock.time, {blocks.id.begin(), blocks.id.end()}, {}, {}};
    mark.centroid.reserve(blocks.size());
    mark.vertex.reserve(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        mark.centroid.push_back(block_displacement(model_, static_cast<Row>(b)));
        mark.vertex.push_back(model_.gridpoints.displacement[blocks.gridpoints[b].first]);
    }
    return mark;
}

void RestMonitor::sample() {
    ++cycles_;
    if (cycles_ % stride_ != 0) return;
    marks_.push_back(mark());
    if (marks_.size() <= most_marks) return;
    for (std::size_t i = 1; 2 * i < marks_.size(); ++i) marks_[i] = std::move(marks_[2 * i]);
    marks_.resize((marks_.size() + 1) / 2);
    stride_ *= 2;
}

std::optional<MovingBody> RestMonitor::moving() const {
    // Late marks only: ignore the elastic rebound at the start of the run.
    constexpr std::size_t least_marks = 4;
    constexpr double least_time = 25; // in largest stable steps; before, springs are still taking up their forces
    if (marks_.size() < least_marks || static_cast<double>(cycles_) * time_step_fraction(model_.settings) < least_time)
        return std::nullopt;
    const Mark now = mark();
    const Mark &middle = marks_[marks_.size() - 2], &first = marks_[marks_.size() - 3], &begin = marks_.front();
    if (first.blocks != now.blocks || middle.blocks != now.blocks || begin.blocks != now.blocks) return std::nullopt;
    const double before = middle.time - first.time, after = now.time - middle.time;
    if (!(before > 0 && after > 0)) return std::nullopt;
    const std::vector<double> acting = acting_forces(model_);
    const auto& blocks = model_.blocks;
    const double step = model_.clock.time_step / time_step_fraction(model_.settings); // the largest stable one
    MovingBody most;
    for (std::size_t b = 0; b < now.blocks.size(); ++b) {
        if (is_held(model_, static_cast<Row>(b)) || !(blocks.inertial_mass[b] > 0)) continue;
        const double quiet = quiet_part * acting[b] * step * step / blocks.inertial_mass[b];
        for (const auto column : {&Mark::centroid, &Mark::vertex}) {
            const Vec3 then = (middle.*column)[b] - (first.*column)[b], lately = (now.*column)[b] - (middle.*column)[b];
            const double gained = lately.norm();
            const bool slows = lately.dot(then) / after < kept_velocity * then.squaredNorm() / before;
            const double whole = ((now.*column)[b] - (begin.*column)[b]).norm();
            if (slows || gained <= quiet || gained <= settling_part * whole || gained <= most.gained) continue;
            const double speed = block_velocity(model_, static_cast<Row>(b)).norm();
            most = {static_cast<Row>(b), speed, gained, gained / after};
        }
    }
    return most.block == no_row ? std::nullopt : std::optional(most);
}

} // namespace kaya
