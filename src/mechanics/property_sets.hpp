// Property sets: one per joint model, joint material and history of commands; contacts share them.
#pragma once

#include "laws/joint_model.hpp"
#include "model/model.hpp"

#include <string>

namespace kaya {

/// The joint model of contacts that no `jmodel` command has selected.
std::string default_joint_model(const Model& model);

/// A row of model.joint_properties with the values of that joint material for that model; equal sets are shared. `place` is the deck line
/// that asked for it.
Row property_set(Model& model, JointRegistry& joints, const std::string& name, std::int32_t material,
                 const std::string& place);

/// The row of an equal set; added when absent.
Row shared_set(Model& model, JointProperties set);

} // namespace kaya
