// Finds blocks at the place of a new one.
#pragma once

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "model/tables/model.hpp"

#include <map>
#include <unordered_map>
#include <vector>

namespace kaya {

/// Boxes of the blocks in grids of cells, one grid for each size (a power of two), so that a new block is compared with its neighbours
/// only. Derived from the model; rebuilt when blocks were deleted or moved.
class Occupied {
public:
    /// The first of the blocks before `row` that has more than a thousandth of the smaller volume in common with it;
    /// no_row when there is none. Remembers the block.
    Row overlapped_by(const Model& model, Row row);

private:
    struct Grid {
        std::unordered_map<std::uint64_t, std::vector<Row>> cells;
        std::vector<Row> rows;
    };
    void add(Row row, const Box& box);

    std::map<int, Grid> grids_; ///< by exponent of the cell's width
    std::vector<Box> boxes_;    ///< by row
    std::int64_t cycle_ = 0;
    std::int32_t made_ = 0; ///< number of the next block
};

} // namespace kaya
