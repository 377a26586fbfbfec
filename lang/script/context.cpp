#include "lang/script/context.hpp"

#include "lang/script/machine.hpp"
#include "lang/script/random.hpp"

namespace kaya::script {

World& world_of(lua_State* L) { return machine_of(L).world; }
const Options& options_of(lua_State* L) { return machine_of(L).options; }
Tables& tables_of(lua_State* L) { return machine_of(L).tables; }
Random& random_of(lua_State* L) { return machine_of(L).random; }
OpenFile& file_of(lua_State* L) { return machine_of(L).file; }
bool is_restoring(lua_State* L) { return machine_of(L).restoring; }

bool is_array(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TTABLE || !lua_getmetatable(L, index)) return false;
    const Machine& machine = machine_of(L);
    const void* const kind = lua_topointer(L, -1);
    lua_pop(L, 1);
    return kind == machine.array_type || kind == machine.grid_type;
}

void push_runtime(lua_State* L, const char* function) {
    push_anchor(L, machine_of(L).anchors.runtime);
    lua_getfield(L, -1, function);
    lua_remove(L, -2);
}

lua_State* state_of(Machine& machine) { return machine.lua; }

void print_line(lua_State* L, const std::string& line) { print_line(machine_of(L), line); }

} // namespace kaya::script
