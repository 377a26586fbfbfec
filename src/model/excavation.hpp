// Blocks that are taken out of the model and kept, and put back.
#pragma once

#include "model/model.hpp"

namespace kaya {

/// Takes blocks out of the model and keeps them, with their zones, materials, groups and held components.
void excavate_blocks(Model& model, const std::vector<Row>& blocks);

/// Puts blocks back where they were when they were taken out, under their old numbers: at rest, without load, stress and
/// displacement, joined with nothing. `rows` are those of Model::excavated.
void fill_blocks(Model& model, const std::vector<Row>& rows);

/// The blocks that may be put back as a model of their own, of the same rows, for range tests and checks.
Model excavated_model(const Model& model);

} // namespace kaya
