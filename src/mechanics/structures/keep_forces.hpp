// Forces of structures whose stiffness changes: docs/theory/cables.md (2), docs/theory/beams-and-liners.md (2).
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Cables, beams and liners with the properties `number`, which were `before`, keep their forces at their present deformation; what comes
/// has the stiffnesses of now.
void keep_structure_forces(Model& model, std::int32_t number, const StructureProperties& before);

} // namespace kaya
