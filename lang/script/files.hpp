// Which files a script may touch.
#pragma once

#include <filesystem>
#include <string>

namespace kaya::script {

struct Machine;

/// What a file is opened for.
enum class Access { reading, writing };

/// The path with all its links followed, when the script may open it so. Else throws.
std::filesystem::path allowed_path(const Machine& machine, const std::string& name, Access access);

} // namespace kaya::script
