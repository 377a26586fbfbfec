// Which files a script may touch.
#pragma once

#include <filesystem>
#include <string>

namespace kaya::script {

struct Machine;

/// The path, when the script may open it: inside of the working folder, or anywhere when trusted. Else
/// throws.
std::filesystem::path allowed_path(const Machine& machine, const std::string& name);

} // namespace kaya::script
