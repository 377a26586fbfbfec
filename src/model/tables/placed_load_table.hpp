// Where loads act on rigid blocks. Blocks::load and Blocks::load_arms are their present sums, and BoundaryHistories has those that change
// with time; the places say which piece of a block that is cut keeps which load. docs/theory/loads.md.
#pragma once

#include "model/tables/boundary_histories.hpp"

namespace kaya {

/// A load is a point with a force, or a triangle under a linear traction with the forces at its corners.
class PlacedLoads : public Table<PlacedLoads> {
public:
    Column<BlockId> block;
    Column<Mat3> arms;   ///< columns: the corners, from the centroid in the block's axes; of a point all are the same
    Column<Mat3> forces; ///< columns: forces at the corners, global axes; of a point the first is all of it
    Column<std::int32_t> function; ///< row of Model::time_functions, or constant_in_time

    template <class Visit> void columns(Visit&& visit) {
        visit("block", block, link<Blocks>());
        visit("arms", arms, Role::geometry);
        visit("forces", forces, Role::load);
        visit("function", function, ColumnRole<TimeFunction>{Role::condition, true});
    }
};

} // namespace kaya
