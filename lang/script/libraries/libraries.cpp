#include "lang/script/libraries/libraries.hpp"

#include "lang/script/libraries/families.hpp"
#include "lang/script/libraries/fish_values.hpp"
#include "lang/script/libraries/lua_library.hpp"
#include "lang/script/libraries/runtime.hpp"
#include "lang/script/names/chunks.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/names/handle_type.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/arithmetic.hpp"
#include "lang/script/state/guard.hpp"

namespace kaya::script {

namespace {

/// Stores a new table in the registry.
int new_table(lua_State* L) {
    lua_newtable(L);
    return luaL_ref(L, LUA_REGISTRYINDEX);
}

} // namespace

void open_libraries(lua_State* L) {
    luaL_openlibs(L);
    fish_of(L).globals = new_table(L);
    fish_of(L).called = new_table(L);
    names_of(L).readers = new_table(L);
    names_of(L).writers = new_table(L);
    names_of(L).extras = new_table(L);
    chunks_of(L).modules = new_table(L);
    open_diagnostics(L);
    open_handles(L);
    open_vectors(L);
    open_text_arithmetic(L);
    open_runtime(L);
    add_mathematics(L);
    add_texts(L);
    add_tables(L);
    add_run_functions(L);
    add_ranges(L);
    add_files(L);
    add_accessors(L);
    add_traversals(L);
    add_materials(L);
    add_modern_names(L);
    add_value_functions(L);
    open_library(L);
}

} // namespace kaya::script
