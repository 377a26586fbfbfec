// Structures in the rock and on its faces: cables, beams and liners.
#pragma once

#include "model/structures/cables.hpp"
#include "model/structures/members.hpp"
#include "model/tables/model.hpp"

namespace kaya {

/// Calls push(block, force, place, moment) for each node in the rock with what the structures do to it. Cables have the forces that their nodes
/// have now, beams and liners those of the last cycle.
template <class Push> void each_structure_force(const Model& model, const Push& push) {
    const auto& members = model.structures.member_nodes;
    for (Row node = 0; node < static_cast<Row>(members.size()); ++node)
        if (const Row block = rock_block(model, members, node); block != no_row)
            push(block, members.rock_force[node], members.position[node], members.rock_moment[node]);
    const auto& cables = model.structures.cable_nodes;
    for (Row node = 0; node < static_cast<Row>(cables.size()); ++node)
        if (const Row block = rock_block(model, cables, node); block != no_row)
            push(block, cables.force[node], cables.position[node], Vec3(Vec3::Zero()));
}

/// Places nodes again whose block was deleted or changed its shape.
void place_structures(Model& model);

/// Applies properties to structures: tension to new cables, masses and stiffnesses to nodes of beams and liners. Throws Diagnostic when
/// properties are missing, or belong to another kind.
void take_structure_properties(Model& model);

} // namespace kaya
