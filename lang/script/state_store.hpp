// The script state as plain data, and back.
#pragma once

#include "lang/script/state.hpp"

namespace kaya::script {

struct Machine;

ScriptState stored_state(Machine& machine);
/// `machine` is new: nothing has run in it.
void restore_state(Machine& machine, const ScriptState& state);

} // namespace kaya::script
