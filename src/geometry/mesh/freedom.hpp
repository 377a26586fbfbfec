// Admissible motion of a mesh point. Private to geometry.
#pragma once

#include "base/vector.hpp"

namespace kaya {

enum class Freedom { nowhere, along_line, in_plane, anywhere };

/// Allowed motion of a point on a line or in a plane: the line's direction, the plane's normal.
struct Motion {
    Freedom freedom = Freedom::anywhere;
    Vec3 axis = Vec3::Zero();
};

} // namespace kaya
