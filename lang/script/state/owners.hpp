// The five owners of a Lua state. Each is defined on its own floor, whose header has the function that finds it.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

struct LuaState;
struct Names;
struct Fish;
struct Chunks;
struct Hooks;

struct Owners {
    LuaState* state = nullptr; ///< state/lua_state.hpp
    Names* names = nullptr;    ///< names/names.hpp
    Fish* fish = nullptr;      ///< names/fish.hpp
    Chunks* chunks = nullptr;  ///< names/chunks.hpp
    Hooks* hooks = nullptr;    ///< names/hooks.hpp
};

inline const Owners& owners_of(lua_State* L) { return **static_cast<const Owners**>(lua_getextraspace(L)); }

} // namespace kaya::script
