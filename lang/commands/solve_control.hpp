// The command that pushes a model past its peak.
#pragma once

#include "lang/interp/spec.hpp"

namespace kaya::lang {

CommandSpec solve_control();

} // namespace kaya::lang
