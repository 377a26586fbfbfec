// water: a table or a field of pressure in joints.
#include "commands/session/fresh_water.hpp"
#include "commands/session/ground.hpp"
#include "commands/session/handlers.hpp"

#include <algorithm>

namespace kaya {

void run(Session& session, const lang::WaterCommand& command) {
    using Kind = lang::WaterCommand::Kind;
    auto& settings = session.engine.model.settings;
    ModelEdit(session.engine.model, Change::properties);
    if (command.kind == Kind::off) {
        settings.water = Water::none;
        std::ranges::fill(session.engine.model.sub_contacts.pore_pressure, 0.0);
        return;
    }
    if (command.kind == Kind::pressure) {
        settings.water = Water::field;
        settings.water_value = command.pressure;
        settings.water_direction = command.gradient;
        return;
    }
    const double density = command.density ? *command.density : density_of_fresh_water(session, command.place);
    if (command.kind == Kind::ground) {
        const Vec3& down = settings.gravity;
        if (down.x() != 0 || down.y() != 0 || down.z() > 0)
            throw Diagnostic("below a ground surface water needs gravity along -z",
                             "write for example: gravity 0 0 -9.81")
                .at(command.place);
        session.engine.model.water_ground = ground_of(session, command.file, command.origin, command.place);
        settings.water = Water::ground;
        settings.water_value = density;
        return;
    }
    const double length = command.normal.norm();
    const double g = settings.gravity.norm();
    if (!(length > 0) || (g > 0 && !(-command.normal.dot(settings.gravity) > 1e-6 * length * g)))
        throw Diagnostic(session.deck.in_words("the normal of the water table must point up, against gravity",
                                               "the normal of the water plane must point down, along gravity"),
                         session.deck.in_words("write for example: water table 0 0 10 normal 0 0 1",
                                               "write for example: block water plane origin 0 0 10 normal 0 0 -1"))
            .at(command.place);
    if (g == 0)
        session.warn(Diagnostic("there is no gravity yet, so the water has no weight",
                                "its pressure follows the gravity of the moment")
                         .at(command.place));
    settings.water = Water::table;
    settings.water_value = density;
    settings.water_origin = command.origin;
    settings.water_direction = command.normal / length;
}

void add_handlers(HandlerTable& table, lang::WaterCommands list) { fill(table, list); }

} // namespace kaya
