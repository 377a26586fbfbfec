// The script state as plain data, and back.
#pragma once

#include "lang/script/values/state.hpp"

namespace kaya::script {

ScriptState stored_state(lua_State* L);
/// The state is new: nothing has run in it.
void restore_state(lua_State* L, const ScriptState& state);

/// The model is replaced and the scripts stay: values that belonged to its objects (b_extra) are dropped, and handles of them become stale.
/// With a state, the values that belong to its objects are added, and tables of numbers that do not exist. Throws Diagnostic, with nothing
/// changed, when the state is damaged.
void change_model(lua_State* L, const ScriptState* state);

} // namespace kaya::script
