// Joint model and properties of contacts that do not exist yet.
#pragma once

#include "laws/joint_model.hpp"
#include "model/model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace kaya {

/// Joint model, unless `name` is empty, and values by property name of contacts that are found from now on. Throws Diagnostic as
/// set_joint_properties (contact_properties.hpp) does; the index of the wrong item is returned through `failed`.
void set_new_joints(Model& model, JointRegistry& joints, const std::string& name,
                    const std::vector<std::pair<std::string, double>>& items, const std::string& place,
                    std::size_t* failed);

} // namespace kaya
