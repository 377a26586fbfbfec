// All names that scripts know without a definition.
#pragma once

namespace kaya::script {

struct Machine;

/// Opens them in a new machine, in an order: later ones use earlier ones.
void open_libraries(Machine& machine);

} // namespace kaya::script
