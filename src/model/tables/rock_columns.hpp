// Columns of tables whose rows are points of structures in the rock.
#pragma once

#include "model/tables/blocks.hpp"
#include "model/tables/column.hpp"

#include <array>
#include <cstdint>

namespace kaya {

/// Columns of a table whose rows lie in blocks. Rows are placed again when their block was deleted or changed its shape.
struct RockPoints {
    Column<BlockId> block;                 ///< an id of none: outside of the rock
    Column<std::int32_t> shape;            ///< Blocks::shape when it was placed there
    Column<Row> zone;                      ///< counted from the first of its block; no_row in a rigid block
    Column<std::array<double, 4>> weights; ///< of the zone's gridpoints, sum 1
    Column<Vec3>
        local; ///< in a rigid block: from its centroid, in its own axes; in a zone: from the place that its weights give

    template <class Visit> void rock_columns(Visit&& visit) {
        visit("block", block, link<Blocks>());
        visit("shape", shape, Role::identity);
        visit("zone", zone, Role::local_link);
        visit("weights", weights, Role::geometry);
        visit("local", local, Role::geometry);
    }
};

} // namespace kaya
