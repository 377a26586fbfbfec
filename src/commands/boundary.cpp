// fix, free, gravity, bound, initialize, reset.
#include "commands/handlers.hpp"

#include "mechanics/boundary.hpp"
#include "mechanics/contact_properties.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya {

namespace {

constexpr std::array axis_names{"x", "y", "z"};

StressField stress_field(const lang::Boundary& command) {
    const auto stress = [](const std::array<double, 6>& six) { return Stress(six.data()); };
    StressField field;
    field.at_origin = stress(*command.stress);
    field.gradient = {stress(command.x_gradient), stress(command.y_gradient), stress(command.z_gradient)};
    return field;
}

void reset_time(Session& session) { session.model.clock.time = 0; }

void reset_histories(Session& session) { session.model.histories = Histories{}; }

void reset_displacements(Session& session) {
    std::ranges::fill(session.model.gridpoints.displacement, Vec3::Zero());
    std::ranges::fill(session.model.blocks.displacement, Vec3::Zero());
}

void reset_velocities(Session& session) {
    // Prescribed components stay: a boundary condition is no initial condition.
    auto& points = session.model.gridpoints;
    for (std::size_t row = 0; row < points.size(); ++row)
        for (int axis = 0; axis < 3; ++axis)
            if ((points.fixed[row] & (fix_x << axis)) == 0) points.velocity[row][axis] = 0;
    auto& blocks = session.model.blocks;
    for (std::size_t row = 0; row < blocks.size(); ++row)
        for (int axis = 0; axis < 3; ++axis) {
            if ((blocks.fixed[row] & (fix_x << axis)) == 0) blocks.velocity[row][axis] = 0;
            if ((blocks.fixed[row] & (fix_rx << axis)) == 0) blocks.rotational_velocity[row][axis] = 0;
        }
}

void reset_joint_displacements(Session& session) {
    auto& points = session.model.sub_contacts;
    std::ranges::fill(points.normal_displacement, 0.0);
    for (auto& column : points.shear_displacement.component) std::ranges::fill(column, 0.0);
}

void reset_energy(Session& session) {
    // The account is opened anew: what moves now is what it starts with.
    auto& energy = session.model.energy;
    const double kinetic = energy.kinetic;
    energy = Energy{};
    energy.kinetic = energy.start = kinetic;
}

void reset_damping(Session& session) { session.model.clock.global_viscosity = 0; }

struct ResetEntry {
    std::string_view word;
    void (*reset)(Session&);
};
constexpr std::array<ResetEntry, 7> resets{{
    {"time", reset_time},
    {"hist", reset_histories},
    {"disp", reset_displacements},
    {"vel", reset_velocities},
    {"jdisp", reset_joint_displacements},
    {"energy", reset_energy},
    {"damp", reset_damping},
}};

} // namespace

void run(Session& session, const lang::Fix& command) {
    fix_blocks(session.model, session.pick(ObjectKind::block, command.range));
}

void run(Session& session, const lang::Free& command) {
    free_blocks(session.model, session.pick(ObjectKind::block, command.range));
}

void run(Session& session, const lang::Gravity& command) { session.model.settings.gravity = command.value; }

void run(Session& session, const lang::Boundary& command) {
    const auto points = session.pick(ObjectKind::gridpoint, command.range);
    if (points.empty()) return;
    for (int axis = 0; axis < 3; ++axis) {
        if (command.velocity[axis]) prescribe_velocity(session.model, points, axis, *command.velocity[axis]);
        if (command.free[axis]) release_velocity(session.model, points, axis);
        if (!command.load[axis]) continue;
        add_load(session.model, points, axis, *command.load[axis]);
        // Repeated loads add up, at every gridpoint: the number shows what the total became.
        session.output.say(fmt::format("{}load {} added at {} gridpoints", axis_names[axis],
                                       number_text(*command.load[axis]), points.size()));
    }
    if (!command.stress) return;
    find_contacts(session.model, session.joints); // they tell which faces are exterior
    if (add_stress(session.model, points, stress_field(command)) > 0) return;
    session.warn(
        Diagnostic(fmt::format("no face on the surface has all its corners among the {} gridpoints in range",
                               points.size()),
                   "the stress has no effect")
            .at(command.range.place ? command.range.place : command.place));
}

void run(Session& session, const lang::Initialize& command) {
    auto& model = session.model;
    for (const Row point : session.pick(ObjectKind::gridpoint, command.range)) {
        const Row block = model.gridpoints.block[point];
        for (int axis = 0; axis < 3; ++axis) {
            if (!command.velocity[axis]) continue;
            model.gridpoints.velocity[point][axis] = *command.velocity[axis];
            if (!model.blocks.deformable[block]) model.blocks.velocity[block][axis] = *command.velocity[axis];
        }
    }
}

void run(Session& session, const lang::Reset& command) {
    for (const auto& word : command.what) {
        const auto found = std::ranges::find(resets, std::string_view(word), &ResetEntry::word);
        if (found == resets.end()) throw std::logic_error("reset: no entry for '" + word + "'");
        found->reset(session);
    }
}

} // namespace kaya
