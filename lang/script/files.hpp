// Which files a script may touch.
#pragma once

#include "lang/script/lua_headers.hpp"

#include <filesystem>
#include <string>

namespace kaya::script {

/// What a file is opened for.
enum class Access { reading, writing };

/// The path with all its links followed, when the script may open it so. Else throws.
std::filesystem::path allowed_path(lua_State* L, const std::string& name, Access access);

} // namespace kaya::script
