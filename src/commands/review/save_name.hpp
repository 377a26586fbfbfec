// Names of save files.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// The suffix that `save` adds to a name.
inline constexpr std::string_view save_ending = ".kaya.h5";

/// The name of the file of `save NAME` and `restore NAME`.
std::string save_name(const std::string& name);

} // namespace kaya
