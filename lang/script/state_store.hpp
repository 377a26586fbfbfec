// The script state as plain data, and back.
#pragma once

#include "lang/script/state.hpp"

namespace kaya::script {

struct Machine;

ScriptState stored_state(Machine& machine);
/// `machine` is new: nothing has run in it.
void restore_state(Machine& machine, const ScriptState& state);

/// The model is replaced and the scripts stay: values that belonged to its objects (b_extra) are dropped, and handles of them become stale.
/// With a state, the values that belong to its objects are added, and tables of numbers that do not exist. Throws Diagnostic, with nothing
/// changed, when the state is damaged.
void change_model(Machine& machine, const ScriptState* state);

} // namespace kaya::script
