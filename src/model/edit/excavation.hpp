// Blocks that are excavated and can be put back.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Moves blocks out of the model, with their zones, materials, groups and held components.
void excavate_blocks(Model& model, const std::vector<Row>& blocks);

/// Restores blocks at their former positions, under their old numbers: at rest, without load, stress and displacement, not joined. `rows`
/// are those of Model::excavated.
void fill_blocks(Model& model, const std::vector<Row>& rows);

/// The excavated blocks as a model with the same rows, for range tests and checks.
Model excavated_model(const Model& model);

} // namespace kaya
