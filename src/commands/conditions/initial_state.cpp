// initialize and insitu: the initial state.
#include "base/counted.hpp"
#include "commands/review/text_doubts.hpp"
#include "commands/session/all_or_nothing.hpp"
#include "commands/session/bodies.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/plausible.hpp"

#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/cycle/insitu.hpp"

#include <algorithm>

namespace kaya {

namespace {

template <class Values> bool any(const Values& values) {
    return std::ranges::any_of(values, [](const auto& value) { return value.has_value(); });
}

StressField stress_field(const lang::InSitu& command) {
    const auto stress = [](const std::array<double, 6>& six) { return Stress(six.data()); };
    return {stress(*command.stress),
            {stress(command.x_gradient), stress(command.y_gradient), stress(command.z_gradient)}};
}

void warn_of_open_faces(Session& session, const lang::InSitu& command, const OpenFaces& open) {
    if (open.joints == 0) return;
    session.warn(Diagnostic(fmt::format("the faces of {} do not meet, they are up to {:.3g} apart",
                                        counted(open.joints, "joint"), open.widest),
                            "their stress acts across the gap as in a closed joint; move the blocks together, or leave "
                            "open joints out with a range")
                     .at(command.place));
}

void put_stress(Session& session, const lang::InSitu& command) {
    auto& model = session.engine.model;
    find_contacts(model, session.engine.joints);
    const auto test = [&](ObjectKind kind) { return session.test_of(kind, command.range); };
    const auto zones = select(model, ObjectKind::zone, test(ObjectKind::zone));
    const auto points = select(model, ObjectKind::sub_contact, test(ObjectKind::sub_contact));
    if (zones.empty() && points.empty()) {
        session.warn(Diagnostic("no zone and no joint is in range", "the command has no effect")
                         .at(command.range.place ? command.range.place : command.place));
        return;
    }
    warn_of(session, doubts_of(command));
    auto& joints = session.engine.joints;
    if (command.stress) {
        warn_of_open_faces(session, command, set_insitu_stress(model, joints, zones, points, stress_field(command)));
        return;
    }
    try {
        const auto& [kx, ky] = *command.topography;
        warn_of_open_faces(session, command, set_topography_stress(model, joints, zones, points, kx, ky));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void put_pore_pressure(Session& session, const lang::RangePhrase& range, const lang::LinearNumber& pressure) {
    Model& model = session.engine.model;
    const auto points = session.pick(ObjectKind::gridpoint, range);
    set_pore_pressure(model, points, pressure.at_origin, pressure.gradient);
    const auto below = std::ranges::count_if(points, [&](Row g) { return model.gridpoints.pore_pressure[g] < 0; });
    if (below > 0)
        session.program.output.say(
            fmt::format("the pressure is below 0 at {}, and counts as 0 there", counted(below, "gridpoint")));
}

/// Throws Diagnostic when the range holds rigid blocks only; warns when it holds nothing.
void refuse_stress_without_zones(Session& session, const lang::Initialize& command) {
    if (!select(session.engine.model, ObjectKind::block, session.test_of(ObjectKind::block, command.range)).empty())
        throw Diagnostic("all blocks in range are rigid, and rigid blocks have no stress",
                         "give them zones before it (generate edge ...); `insitu stress` loads joints of rigid blocks")
            .at(command.place);
    session.warn(Diagnostic("no zone is in range", "the stresses have no effect")
                     .at(command.range.place ? command.range.place : command.place));
}

} // namespace

void run(Session& session, const lang::Initialize& command) {
    auto& model = session.engine.model;
    if (any(command.velocity) || any(command.displacement)) {
        const Bodies bodies = pick_bodies(session, command.range);
        check_rotation(model, bodies, command.velocity, command.place);
        for (int k = 0; k < components; ++k)
            if (command.velocity[k]) initialize_velocity(model, bodies, k, *command.velocity[k]);
        for (int axis = 0; axis < 3; ++axis)
            if (command.displacement[axis]) initialize_displacement(model, bodies, axis, *command.displacement[axis]);
    }
    if (any(command.stress)) {
        const auto zones = select(model, ObjectKind::zone, session.test_of(ObjectKind::zone, command.range));
        if (zones.empty()) refuse_stress_without_zones(session, command);
        for (int k = 0; k < 6; ++k)
            if (const auto& stress = command.stress[k])
                set_stress_component(model, zones, k, stress->at_origin, stress->gradient);
    }
    if (command.pore_pressure) put_pore_pressure(session, command.range, *command.pore_pressure);
}

void run(Session& session, const lang::InSitu& command) {
    all_or_nothing(session, [&] {
        if (command.pore_pressure) put_pore_pressure(session, command.range, *command.pore_pressure);
        if (command.stress || command.topography) put_stress(session, command);
    });
}

void add_handlers(HandlerTable& table, lang::InitialStateCommands list) { fill(table, list); }

} // namespace kaya
