// Structures in the rock and on its faces: cables, beams and liners.
#pragma once

#include "model/cables.hpp"
#include "model/members.hpp"
#include "model/structure_properties.hpp"

#include <cstdint>
#include <map>

namespace kaya {

struct Structures {
    Cables cables;
    CableNodes cable_nodes;
    Members members;
    MemberNodes member_nodes;
    BeamElements beams;
    LinerElements liners;
    std::map<std::int32_t, StructureProperties> properties;
    std::int32_t next_number = 1;

    bool any() const { return !cables.empty() || !members.empty() || !properties.empty(); }
    /// Whether the model has any.
    bool stand() const { return !cables.empty() || !members.empty(); }
};

/// Places nodes again whose block was deleted or changed its shape.
void place_structures(Model& model);

/// Applies properties to structures: tension to new cables, masses and stiffnesses to nodes of beams and liners. Throws Diagnostic when
/// properties are missing, or belong to another kind.
void take_structure_properties(Model& model);

} // namespace kaya
