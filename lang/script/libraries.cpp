#include "lang/script/libraries.hpp"

#include "lang/script/arithmetic.hpp"
#include "lang/script/built_ins.hpp"
#include "lang/script/fish_values.hpp"
#include "lang/script/guard.hpp"
#include "lang/script/handle_type.hpp"
#include "lang/script/lua_library.hpp"
#include "lang/script/machine.hpp"
#include "lang/script/runtime.hpp"

namespace kaya::script {

namespace {

/// Stores a new table in the registry.
int new_table(lua_State* L) {
    lua_newtable(L);
    return luaL_ref(L, LUA_REGISTRYINDEX);
}

} // namespace

void open_libraries(Machine& machine) {
    lua_State* L = machine.lua;
    luaL_openlibs(L);
    machine.anchors.globals = new_table(L);
    machine.anchors.functions = new_table(L);
    machine.anchors.readers = new_table(L);
    machine.anchors.writers = new_table(L);
    machine.anchors.extras = new_table(L);
    machine.anchors.modules = new_table(L);
    open_diagnostics(L);
    open_handles(L);
    open_vectors(L);
    open_text_arithmetic(L);
    open_runtime(machine);
    add_mathematics(machine);
    add_texts(machine);
    add_tables(machine);
    add_run_functions(machine);
    add_ranges(machine);
    add_files(machine);
    add_accessors(machine);
    add_traversals(machine);
    add_materials(machine);
    add_modern_names(machine);
    add_value_functions(machine);
    open_library(machine);
}

} // namespace kaya::script
