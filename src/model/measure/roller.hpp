// Motion along held directions.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// The change of a velocity that makes its components along the roller's directions equal to `speed`; held components (Fixity bits) are
/// unchanged. A force loses its components along directions with the speed 0.
Vec3 roller_change(const Roller& roller, const Vec3& value, std::uint8_t fixed, const Vec3& speed);

} // namespace kaya
