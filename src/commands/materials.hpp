// Checks of materials that are made when they come into use.
#pragma once

#include "commands/session.hpp"

namespace kaya {

/// Throws Diagnostic when a block material in use has one of Young's modulus and Poisson's ratio but
/// not the other; warns, once each, about joint properties that no joint model in use knows.
void check_materials(Session& session);

/// Rows of Model::joint_properties that contacts use; others are left from earlier commands.
std::set<Row> property_sets_in_use(const Model& model);

} // namespace kaya
