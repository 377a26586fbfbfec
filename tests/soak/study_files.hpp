// Studies: a deck and its study file, with values that are valid, at limits or odd.
#pragma once

#include "trial.hpp"
#include "values.hpp"

namespace kaya::soak {

/// The study is the first of the files. Few runs, so that a case is short.
Case study(Chance& c);

} // namespace kaya::soak
