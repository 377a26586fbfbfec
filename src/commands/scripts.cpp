// def ... end, @function, lua.
#include "commands/handlers.hpp"

namespace kaya {

void run(Session& session, const lang::FishDefinition& command) {
    session.scripts->define_fish(command.text, command.place);
}

void run(Session& session, const lang::FishCall& command) {
    session.scripts->call(command.expression, command.place);
}

void run(Session& session, const lang::LuaChunk& command) {
    session.scripts->run_lua(command.text, command.place);
}

void run(Session& session, const lang::LuaFile& command) {
    session.scripts->run_lua_file(session.input_file(command.file), command.place);
}

} // namespace kaya
