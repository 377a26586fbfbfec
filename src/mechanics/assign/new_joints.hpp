// Joint model and properties of contacts that do not exist yet.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace kaya {

/// Joint model, unless `name` is empty, and values by property name of contacts that are found from now on. Throws Diagnostic as
/// set_joint_properties (contact_properties.hpp) does; the index of the wrong item is returned through `failed`.
void set_new_joints(Model& model, JointRegistry& joints, const std::string& name,
                    const std::vector<std::pair<std::string, double>>& items, const std::string& place,
                    std::size_t* failed);

/// A row of joint properties with the values of another row, or of -1, the initial ones, and these values; with `name`, of that joint model
/// and its initial values. Throws as set_new_joints does.
Row changed_joints(Model& model, JointRegistry& joints, Row row, const std::string& name,
                   const std::vector<std::pair<std::string, double>>& items, const std::string& place,
                   std::size_t* failed);

/// Gives contacts a row of joint properties.
void give_joints(Model& model, JointRegistry& joints, const std::vector<Row>& contacts, Row properties);

} // namespace kaya
