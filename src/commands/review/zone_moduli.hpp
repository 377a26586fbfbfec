// Young's modulus and Poisson's ratio in place of the moduli that zone models have.
#pragma once

#include "lang/commands/commands.hpp"

#include <functional>
#include <string>
#include <vector>

namespace kaya {

inline double bulk_modulus(double young, double poisson) { return young / (3 * (1 - 2 * poisson)); }
inline double shear_modulus(double young, double poisson) { return young / (2 * (1 + poisson)); }

/// The properties of a line with `young` and `poisson` as `bulk` and `shear`. `has` says which words the zone model takes: one with a
/// property `young` gets the line as it is. Throws Diagnostic at the word when one of the two lacks, or is out of its limits.
std::vector<lang::Property::Item> with_moduli(const std::vector<lang::Property::Item>& items,
                                              const std::function<bool(const std::string&)>& has);

} // namespace kaya
