// Property sets: one per joint model, joint material and history of commands; contacts share them.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace kaya {

using PropertyItems = std::vector<std::pair<std::string, double>>;

/// Copies the items that the model knows into the values. Throws for a value outside its limits and, when `strict`, for a name that the
/// model does not know.
void put_values(const JointModel& joint, std::vector<double>& values, const PropertyItems& items, bool strict,
                std::size_t* failed);

/// The joint model that a constitutive number (`change jcons n`) stands for. Throws Diagnostic for a number that
/// stands for none.
std::string joint_model_of_number(const Model& model, std::int32_t number);

/// The joint model of contacts that no `jmodel` command has selected.
std::string default_joint_model(const Model& model);

/// The values of a joint material for a joint model.
JointProperties set_of_material(const Model& model, JointRegistry& joints, const std::string& name,
                                std::int32_t material, const std::string& place);

/// A row of model.joint_properties with the values of that joint material for that model; equal sets are shared. `place` is the deck line
/// that asked for it.
Row property_set(Model& model, JointRegistry& joints, const std::string& name, std::int32_t material,
                 const std::string& place);

/// The row of an equal set; added when absent.
Row shared_set(Model& model, JointProperties set);

} // namespace kaya
