// Structures in the rock and on its faces: cables, beams and liners.
#pragma once

#include "model/structures/cables.hpp"
#include "model/structures/members.hpp"
#include "model/tables/structure_tables.hpp"

namespace kaya {

struct Model;

/// Places nodes again whose block was deleted or changed its shape.
void place_structures(Model& model);

/// Applies properties to structures: tension to new cables, masses and stiffnesses to nodes of beams and liners. Throws Diagnostic when
/// properties are missing, or belong to another kind.
void take_structure_properties(Model& model);

} // namespace kaya
