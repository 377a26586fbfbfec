// The purpose of the damping, and the part of the largest stable time step that a run uses with it.
#pragma once

#include "model/tables/settings.hpp"

namespace kaya {

/// Whether the damping is that of static solutions. Weaker local damping is used for motion that is to be followed.
bool damps_to_rest(const Settings& settings);

/// The fraction of the largest stable step that is used. In static solution stability is enough; motion that is to be followed needs
/// several steps for each of its periods, or opening and closing contacts create energy.
double time_step_fraction(const Settings& settings);

} // namespace kaya
