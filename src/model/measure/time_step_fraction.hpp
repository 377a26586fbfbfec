// The part of the largest stable time step that a run uses.
#pragma once

#include "model/tables/settings.hpp"

namespace kaya {

/// The fraction of the largest stable step that is used. In static solution stability is enough; motion that is to be followed needs
/// several steps for each of its periods, or opening and closing contacts create energy.
double time_step_fraction(const Settings& settings);

} // namespace kaya
