// Velocities and loads that change with time: docs/theory/loads.md.
#include "mechanics/common/remedy.hpp"
#include "mechanics/supports/apply_histories.hpp"
#include "mechanics/lanes/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {

namespace {

/// Scripts see the time for which their value is wanted.
class TimeOfScripts {
public:
    TimeOfScripts(Clock& clock, double time) : clock_(clock), own_(clock.time) { clock.time = time; }
    ~TimeOfScripts() { clock_.time = own_; }

private:
    Clock& clock_;
    double own_;
};

double value_of(const TimeFunction& function, double time, const Hooks& hooks) {
    const double angle = 2 * std::numbers::pi * function.frequency * time;
    const bool acts = time >= 0 && (function.duration == 0 || time <= function.duration);
    switch (function.kind) {
    case TimeFunction::Kind::sine: return acts ? std::sin(angle) : 0;
    case TimeFunction::Kind::cosine: return acts ? std::cos(angle) : 0;
    case TimeFunction::Kind::impulse: return acts ? 0.5 * (1 - std::cos(angle)) : 0;
    case TimeFunction::Kind::table: return hooks.table_value(function.table, time);
    case TimeFunction::Kind::script: return hooks.script_value(function.script);
    }
    return 0;
}

void fill(Model& model, const std::vector<std::int32_t>& functions, double time, const Hooks& hooks,
          std::vector<double>& factors) {
    const TimeOfScripts of_scripts(model.clock, time);
    for (const auto row : functions) {
        const TimeFunction& function = model.time_functions[row];
        try {
            factors[row] = value_of(function, time, hooks);
            if (!std::isfinite(factors[row]))
                throw Advised(
                    fmt::format("the history of a boundary condition gives {} at time {:.6g}", factors[row], time),
                    Advice::check_time_function, {}, Fault::run);
        } catch (Diagnostic& failure) {
            if (!function.place.empty()) failure.add("history of the boundary condition given at " + function.place);
            throw;
        }
    }
}

/// The effect of a velocity jump on the energy account. The phase that moves the body uses the new velocity on both sides of the step, so
/// the work of every force is off by the jump in half of the step before; this is corrected here.
struct Jump {
    double mass;
    double force; ///< of joints and zones, of one component
    double weight;

    void set(double& velocity, double value, double step, HistorySums& sums) const {
        const double jump = value - velocity;
        const double gain = 0.5 * mass * (value * value - velocity * velocity);
        sums.kinetic += gain;
        sums.inner_power += jump * force;
        sums.boundary += gain + 0.5 * jump * (force + weight) * step;
        sums.gravity -= 0.5 * jump * weight * step;
        velocity = value;
    }
};

double step_before(const Model& model) { return model.energy.step_before(model.clock.step_before()); }

void spin_block(Model& model, Row b, int axis, double value, HistorySums& sums) {
    Vec3& spin = model.blocks.rotational_velocity[b];
    Vec3& momentum = model.blocks.angular_momentum[b];
    const double before = 0.5 * spin.dot(momentum), jump = value - spin[axis];
    spin[axis] = value;
    if (model.blocks.body[b] != 0) return; // the momentum is that of the body, and follows when it moves
    momentum = inertia_now(model, b) * spin;
    const double gain = 0.5 * spin.dot(momentum) - before;
    sums.kinetic += gain;
    sums.inner_power += jump * model.blocks.moment[b][axis];
    sums.boundary += gain + 0.5 * jump * model.blocks.moment[b][axis] * step_before(model);
}

void move_block(Model& model, Row b, int component, double value, HistorySums& sums) {
    auto& blocks = model.blocks;
    if (component >= 3) return spin_block(model, b, component - 3, value, sums);
    const double weight = blocks.mass[b] * model.settings.gravity[component];
    const Jump jump{blocks.inertial_mass[b], blocks.force[b][component], weight};
    jump.set(blocks.velocity[b][component], value, step_before(model), sums);
}

void move_gridpoint(Model& model, Row g, int component, double value, HistorySums& sums) {
    auto& points = model.gridpoints;
    if (!(points.fixed[g] & (1 << component))) return;
    const double weight = points.mass[g] * model.settings.gravity[component];
    const Jump jump{points.inertial_mass[g], points.force[g][component], weight};
    jump.set(points.velocity[g][component], value, step_before(model), sums);
}

} // namespace

HistoryLists list_boundary_histories(const Model& model) {
    HistoryLists lists;
    const auto note = [](std::vector<std::int32_t>& functions, std::int32_t function) {
        if (std::ranges::find(functions, function) == functions.end()) functions.push_back(function);
    };
    for (std::size_t i = 0; i < model.boundary_histories.size(); ++i) {
        const bool velocity = model.boundary_histories.what[i] == BoundaryHistories::What::velocity;
        (velocity ? lists.velocities : lists.loads).push_back(static_cast<Row>(i));
        note(velocity ? lists.velocity_functions : lists.load_functions, model.boundary_histories.function[i]);
    }
    lists.factors.resize(model.time_functions.size(), 0);
    return lists;
}

HistorySums apply_velocity_histories(Model& model, HistoryLists& lists, const Hooks& hooks) {
    HistorySums sums;
    if (lists.velocities.empty()) return sums;
    // The velocity of the step's middle carries bodies from its start to its end.
    const double middle = model.clock.time + 0.5 * model.clock.time_step;
    fill(model, lists.velocity_functions, middle, hooks, lists.factors);
    const auto& histories = model.boundary_histories;
    for (const Row i : lists.velocities) {
        const Row b = model.blocks.ids.row(histories.block[i]);
        if (b == no_row) continue;
        const int component = histories.component[i];
        const double value = histories.amplitude[i] * lists.factors[histories.function[i]];
        const Span points = model.blocks.gridpoints[b];
        if (histories.gridpoint[i] != no_row)
            move_gridpoint(model, points.first + histories.gridpoint[i], component, value, sums);
        else if (!model.blocks.deformable[b]) {
            if (model.blocks.fixed[b] & (1 << component)) move_block(model, b, component, value, sums);
        } else if (component < 3)
            for (Row g = points.first; g < points.end(); ++g) move_gridpoint(model, g, component, value, sums);
    }
    return sums;
}

void apply_load_histories(Model& model, HistoryLists& lists, const Hooks& hooks) {
    if (lists.loads.empty()) return;
    fill(model, lists.load_functions, model.clock.time, hooks, lists.factors);
    auto& histories = model.boundary_histories;
    for (const Row i : lists.loads) {
        const Row b = model.blocks.ids.row(histories.block[i]);
        if (b == no_row) continue;
        const int component = histories.component[i];
        const double value = histories.amplitude[i] * lists.factors[histories.function[i]];
        double& load = histories.gridpoint[i] != no_row
                           ? model.gridpoints.load[model.blocks.gridpoints[b].first + histories.gridpoint[i]][component]
                           : load_component(model.blocks, b, component);
        load = load - histories.acting[i] + value;
        histories.acting[i] = value;
    }
}

} // namespace kaya
