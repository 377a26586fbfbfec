// Functions of Lua that run in cycles, and names for those that histories record.
#include "lang/script/libraries/lua_natives.hpp"
#include "lang/script/names/hooks.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/values.hpp"

#include <array>
#include <fmt/format.h>
#include <string_view>

namespace kaya::script {

namespace {

int add_hook(lua_State* L) {
    static constexpr std::array<std::string_view, 3> moments{"before_cycle", "after_forces", "after_cycle"};
    const std::string name = text_argument(L, 1, "hook");
    LuaHook made;
    for (std::size_t i = 0; i < moments.size(); ++i)
        if (moments[i] == name) made.moment = static_cast<Moment>(i);
    if (lua_type(L, 2) != LUA_TFUNCTION)
        throw Diagnostic(fmt::format("hook.{} needs a function, here it is given {}", name, describe_value(L, 2)), {},
                         Fault::run);
    if (!lua_isnoneornil(L, 3)) {
        made.interval = integer_argument(L, 3, "hook");
        if (made.interval < 1)
            throw Diagnostic(fmt::format("the interval of a hook is {}", made.interval), "it counts cycles from 1 up",
                             Fault::run);
    }
    lua_pushvalue(L, 2);
    made.function = luaL_ref(L, LUA_REGISTRYINDEX);
    hooks_of(L).of_lua.push_back(made);
    hooks_of(L).registered = true;
    lua_pushvalue(L, 2);
    return 1;
}

/// Removes every hook of this function.
int remove_hook(lua_State* L) {
    std::erase_if(hooks_of(L).of_lua, [&](const LuaHook& hook) {
        lua_rawgeti(L, LUA_REGISTRYINDEX, hook.function);
        const bool same = lua_rawequal(L, -1, 1);
        lua_pop(L, 1);
        if (same) luaL_unref(L, LUA_REGISTRYINDEX, hook.function);
        return same;
    });
    return 0;
}

int name_history(lua_State* L) {
    hooks_of(L).registered = true;
    lua_pushstring(L, fmt::format("lua_history_{}", ++hooks_of(L).lua_histories).c_str());
    return 1;
}

constexpr luaL_Reg natives[] = {
    {"add_hook", guarded<add_hook>},
    {"remove_hook", guarded<remove_hook>},
    {"name_history", guarded<name_history>},
    {nullptr, nullptr},
};

} // namespace

void add_hook_natives(lua_State* L) { luaL_setfuncs(L, natives, 0); }

} // namespace kaya::script
