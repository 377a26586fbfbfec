// Checks of materials when they are first used.
#pragma once

#include "commands/session/session.hpp"

namespace kaya {

/// Throws Diagnostic when a block material in use has one of Young's modulus and Poisson's ratio but
/// not the other; warns, once each, about joint properties that no joint model in use knows.
void check_materials(Session& session);

/// The value that `prop` gave to a material, by any spelling of the word: density, bulk, jkn, jfric, ...; 0 if not given. Throws Diagnostic
/// for a word that `prop` does not know.
double material_value(const Model& model, const JointRegistry& joints, std::int64_t number, std::string_view word);

/// Zone models of blocks with zones, of that material or of any.
std::set<std::string> zone_models_in_use(const Model& model, std::optional<std::int32_t> material = {});

/// Rows of Model::joint_properties that joints use; others remain from earlier commands. Ties are not joints.
std::set<Row> property_sets_in_use(const Model& model);

} // namespace kaya
