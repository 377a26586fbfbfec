// Parts of a save file that belong to the session.
#pragma once

#include <string_view>

namespace kaya {

inline constexpr std::string_view part_scripts = "scripts", part_ranges = "named ranges", part_joints = "joint models",
                                  part_surfaces = "sets of surfaces";

} // namespace kaya
