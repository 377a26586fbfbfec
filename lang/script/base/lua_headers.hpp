// The only header that includes Lua; used by the .cpp files of this folder only.
#pragma once

#include <lua.hpp>
