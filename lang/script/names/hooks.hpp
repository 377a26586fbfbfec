// Functions of FISH and Lua that run in cycles.
#pragma once

#include "lang/script/base/options.hpp"
#include "lang/script/state/owners.hpp"
#include "lang/script/values/state.hpp"

#include <cstdint>
#include <vector>

namespace kaya::script {

struct LuaHook {
    Moment moment = Moment::after_cycle;
    std::int64_t interval = 1;
    int function = LUA_NOREF;
};

/// In the order of their registration.
struct Hooks {
    std::vector<StoredHook> of_fish;
    std::vector<LuaHook> of_lua;
    int lua_histories = 0;
    bool registered = false; ///< a chunk registered a hook or a history: it must be stored
};

inline Hooks& hooks_of(lua_State* L) { return *owners_of(L).hooks; }

} // namespace kaya::script
