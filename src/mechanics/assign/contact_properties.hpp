// Assigns joint models and their values to contacts.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace kaya {

/// Updates the contacts of a changed model, and the places of its structures in the blocks; needs no densities. New contacts get the default
/// joint model and material of the settings.
void find_contacts(Model& model, JointRegistry& joints);

/// `jmodel model NAME` on contact rows: a property set per jmat number, filled from `prop jmat`.
void assign_joint_model(Model& model, JointRegistry& joints, const std::vector<Row>& contacts, const std::string& name,
                        const std::string& place);

/// Values by property name, for contact rows. Throws Diagnostic for a name that the model of one of
/// the contacts does not know (did-you-mean, list of names), a value outside its limits, and when the
/// model's check() objects; nothing is changed then. `item` of the exception's context is not used:
/// the failing item's index is returned through `failed` so that the caller can point at it.
void set_joint_properties(Model& model, JointRegistry& joints, const std::vector<Row>& contacts,
                          const std::vector<std::pair<std::string, double>>& items, const std::string& place,
                          std::size_t* failed = nullptr);

/// `prop jmat n`: stores the values with the material and passes them to the property sets made from it.
void set_joint_material(Model& model, JointRegistry& joints, std::int32_t material,
                        const std::vector<std::pair<std::string, double>>& items, const std::string& place,
                        std::size_t* failed = nullptr);

/// `change jmat n`: contacts take the values of another joint material (same joint model).
void change_joint_material(Model& model, JointRegistry& joints, const std::vector<Row>& contacts, std::int32_t material,
                           const std::string& place);

} // namespace kaya
