// Tables and properties of cables, beams and liners.
#pragma once

#include "model/tables/cable_tables.hpp"
#include "model/tables/member_tables.hpp"
#include "model/tables/structure_properties.hpp"

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

} // namespace kaya
