// Strength criteria of the rock and the joints of a model for limit equilibrium.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"
#include "slopes/strength.hpp"

#include <optional>

namespace kaya {

/// Strength of a block: Mohr-Coulomb by `cohesion` and `friction` of its zone model, Hoek-Brown by `constant-sci` and so on; for elastic
/// zones and rigid blocks by cohesion and friction of the material. None without a strength.
std::optional<Strength> rock_strength(const Model& model, JointRegistry& laws, Row block);

/// Friction in degrees and cohesion of a sub-contact: where its state says that it has failed, those after failure that its joint model has. None
/// where the model has neither.
struct RowStrength {
    double friction = 0, cohesion = 0;
};
std::optional<RowStrength> row_strength(const Model& model, const JointModel& law, Row sub_contact);

/// Whether the state of any of its sub-contacts says so.
bool has_failed(const Model& model, Row contact);

/// Strength of a contact: Barton by `jrco` and `jcso`, scaled to the length of the joint; else Coulomb by the strengths of its sub-contacts,
/// mean by area. None when required properties are missing, or its joint model has none of these.
std::optional<Strength> joint_strength(const Model& model, JointRegistry& laws, Row contact);

} // namespace kaya
