// Joint models that are Lua files.
#pragma once

#include "joints/joint_model.hpp"

namespace kaya {

/// The registry takes files with the ending .lua for joint models.
void understand_lua_models(JointRegistry& joints);

} // namespace kaya
