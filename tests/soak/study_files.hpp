// Studies: a deck and a file that says how its parameters vary, with values that are right, at limits and odd.
#pragma once

#include "trial.hpp"
#include "values.hpp"

namespace kaya::soak {

/// The study is the first of the files. Few runs, so that it takes a moment.
Case study(Chance& c);

} // namespace kaya::soak
