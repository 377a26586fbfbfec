#include "lang/script/machine.hpp"

#include "lang/script/arithmetic.hpp"
#include "lang/script/built_ins.hpp"
#include "lang/script/guard.hpp"
#include "lang/script/handles.hpp"
#include "lang/script/lua_library.hpp"
#include "lang/script/runtime.hpp"

#include <cstdio>
#include <new>

namespace kaya::script {

namespace {

/// Keeps a new table in the registry.
int new_table(lua_State* L) {
    lua_newtable(L);
    return luaL_ref(L, LUA_REGISTRYINDEX);
}

} // namespace

Machine::Machine(World& the_world, Options the_options)
    : world(the_world), options(std::move(the_options)), random(options.seed) {
    lua = luaL_newstate();
    if (!lua) throw std::bad_alloc();
    *static_cast<Machine**>(lua_getextraspace(lua)) = this;
    try {
        luaL_openlibs(lua);
        anchors.globals = new_table(lua);
        anchors.functions = new_table(lua);
        anchors.readers = new_table(lua);
        anchors.writers = new_table(lua);
        anchors.extras = new_table(lua);
        anchors.modules = new_table(lua);
        open_diagnostics(lua);
        open_handles(lua);
        open_vectors(lua);
        open_text_arithmetic(lua);
        open_runtime(*this);
        add_mathematics(*this);
        add_texts(*this);
        add_tables(*this);
        add_files(*this);
        add_accessors(*this);
        add_walkers(*this);
        add_materials(*this);
        add_modern_names(*this);
        open_library(*this);
    } catch (...) {
        lua_close(lua);
        throw;
    }
}

Machine::~Machine() { lua_close(lua); }

void print_line(Machine& machine, const std::string& line) {
    if (machine.restoring) return;
    if (machine.sink)
        machine.sink(line);
    else
        std::printf("%s\n", line.c_str());
}

} // namespace kaya::script
