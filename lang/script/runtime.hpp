// R, the functions that translated FISH calls: see the foot of lang/fish/compiler.hpp.
#pragma once

namespace kaya::script {

struct Machine;

void open_runtime(Machine& machine);

} // namespace kaya::script
