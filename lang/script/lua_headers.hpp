// The one place that includes Lua; seen by the .cpp files of this folder only.
#pragma once

#include <lua.hpp>
