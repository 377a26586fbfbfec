#include "lang/script/built_ins.hpp"

#include "lang/script/machine.hpp"

namespace kaya::script {

namespace {
void put(Machine& machine, int anchor, std::string_view name) {
    lua_State* L = machine.lua;
    push_anchor(L, anchor);
    lua_insert(L, -2);
    lua_pushlstring(L, name.data(), name.size());
    lua_insert(L, -2);
    lua_rawset(L, -3);
    lua_pop(L, 1);
}
} // namespace

void add_reader(Machine& machine, std::string_view name, int least, int most) {
    put(machine, machine.anchors.readers, name);
    BuiltIn& built_in = machine.fish.built_ins[std::string(name)];
    built_in.least = least;
    built_in.most = most;
}

void add_writer(Machine& machine, std::string_view name) {
    put(machine, machine.anchors.writers, name);
    machine.fish.built_ins[std::string(name)].writable = true;
}

void add_built_ins(Machine& machine, std::span<const BuiltInFunction> functions) {
    for (const auto& function : functions) {
        lua_pushcfunction(machine.lua, function.read);
        add_reader(machine, function.name, function.least, function.most);
        if (!function.write) continue;
        lua_pushcfunction(machine.lua, function.write);
        add_writer(machine, function.name);
    }
}

} // namespace kaya::script
