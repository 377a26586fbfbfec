// The script state as plain data, and back.
#pragma once

#include "lang/script/state.hpp"

namespace kaya::script {

struct Machine;

ScriptState stored_state(Machine& machine);
/// `machine` is new: nothing has run in it.
void restore_state(Machine& machine, const ScriptState& state);

/// The model is another one, and the scripts stay: what belonged to its objects (b_extra) goes, and handles of them are
/// dead; with a state, what belongs to the objects of that comes, and tables of numbers that are not there. Throws
/// Diagnostic, with nothing changed, when the state is damaged.
void change_model(Machine& machine, const ScriptState* state);

} // namespace kaya::script
