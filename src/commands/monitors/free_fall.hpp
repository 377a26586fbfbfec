// Bodies that have left everything: a run to equilibrium cannot end while one falls.
#pragma once

#include "model/tables/model.hpp"

#include <optional>
#include <vector>

namespace kaya {

/// The blocks that fall freely past all others: docs/theory/stopping.md.
struct FreeFall {
    std::vector<Row> blocks; ///< at least one
    double ratio = 0;        ///< average ratio of the unbalanced force of the others, at most
    double force = 0;        ///< their largest unbalanced force
};

/// None while every body may still meet another one that does not fall.
std::optional<FreeFall> free_fall(const Model& model);

/// Free blocks without contact forces that have gone farther from all others than these are long. None while all blocks are like this.
std::vector<Row> blocks_that_left(const Model& model);

} // namespace kaya
