// Numbers, vectors and places as words.
#pragma once

#include "base/vector.hpp"

#include <string>

namespace kaya {

/// Six significant digits, as FISH writes numbers: 9.94099e-06, 322.077, 20. Zero has no sign.
std::string number_text(double value);

/// "(1, 2.5, 0)"
std::string vector_text(const Vec3& vector);
/// "1, 2.5, 4000000.25": to thousandths far from the origin, where six digits do not tell neighbours apart.
std::string coordinates_text(const Vec3& place);
/// The same in brackets.
std::string place_text(const Vec3& place);

} // namespace kaya
