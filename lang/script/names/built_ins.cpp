#include "lang/script/names/built_ins.hpp"

#include "lang/script/names/names.hpp"
#include "lang/script/state/lua_state.hpp"

namespace kaya::script {

namespace {
void put(lua_State* L, int anchor, std::string_view name) {
    push_anchor(L, anchor);
    lua_insert(L, -2);
    lua_pushlstring(L, name.data(), name.size());
    lua_insert(L, -2);
    lua_rawset(L, -3);
    lua_pop(L, 1);
}
} // namespace

void add_reader(lua_State* L, std::string_view name, int least, int most) {
    put(L, names_of(L).readers, name);
    BuiltIn& built_in = names_of(L).built_ins[std::string(name)];
    built_in.least = least;
    built_in.most = most;
}

void add_writer(lua_State* L, std::string_view name) {
    put(L, names_of(L).writers, name);
    names_of(L).built_ins[std::string(name)].writable = true;
}

void add_built_ins(lua_State* L, std::span<const BuiltInFunction> functions) {
    for (const auto& function : functions) {
        lua_pushcfunction(L, function.read);
        add_reader(L, function.name, function.least, function.most);
        if (!function.write) continue;
        lua_pushcfunction(L, function.write);
        add_writer(L, function.name);
    }
}

} // namespace kaya::script
