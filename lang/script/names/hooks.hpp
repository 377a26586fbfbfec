// Functions of FISH and Lua that run in cycles.
#pragma once

#include "lang/script/base/options.hpp"
#include "lang/script/state/owners.hpp"
#include "lang/script/values/state.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace kaya::script {

struct LuaHook {
    Moment moment = Moment::after_cycle;
    std::int64_t interval = 1;
    int function = LUA_NOREF;
};

struct Hooks {
    std::vector<StoredHook> of_fish; ///< those of one moment in the order of their calls
    std::vector<LuaHook> of_lua;     ///< in the order of their registration
    int lua_histories = 0;
    bool registered = false; ///< a chunk registered a hook or a history: it must be stored
};

/// Behind the hooks of its moment whose location is not larger.
inline void add_hook(std::vector<StoredHook>& hooks, StoredHook hook) {
    const auto after = std::ranges::find_if(hooks, [&hook](const StoredHook& other) {
        return other.moment == hook.moment && other.location > hook.location;
    });
    hooks.insert(after, std::move(hook));
}

inline Hooks& hooks_of(lua_State* L) { return *owners_of(L).hooks; }

} // namespace kaya::script
