// Joint models that are Lua files.
#pragma once

#include "laws/joint_model.hpp"

namespace kaya {

/// The registry takes files with the ending .lua for joint models.
void add_lua_loader(JointRegistry& joints);

} // namespace kaya
