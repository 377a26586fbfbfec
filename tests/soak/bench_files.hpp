// Paths for the benches of joint models and zone models, with the command line that uses them.
#pragma once

#include "trial.hpp"
#include "values.hpp"

namespace kaya::soak {

/// The path is the first of the files.
Case bench(Chance& c);

} // namespace kaya::soak
