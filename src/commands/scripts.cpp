// def ... end, @function, lua.
#include "commands/handlers.hpp"

namespace kaya {

void run(Session& session, const lang::FishDefinition& command) {
    session.scripts->define_fish(command.text, command.place);
}

void run(Session& session, const lang::FishCall& command) {
    session.scripts->call(command.expression, command.place);
}

void run(Session& session, const lang::FishCallback& command) {
    constexpr double forces_are_known = 40; // newer versions number the parts of a cycle
    if (command.remove) return session.scripts->remove_fish_hook(command.function, command.place);
    const auto moment =
        command.location < forces_are_known ? script::Moment::before_cycle : script::Moment::after_forces;
    session.scripts->add_fish_hook(command.function, moment, command.interval, command.place);
}

void run(Session& session, const lang::LuaChunk& command) {
    session.scripts->run_lua(command.text, command.place);
}

void run(Session& session, const lang::LuaFile& command) {
    session.scripts->run_lua_file(session.input_file(command.file), command.place);
}

} // namespace kaya
