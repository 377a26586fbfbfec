// Loads and prescribed velocities of a block that is cut. docs/theory/loads.md.
#pragma once

#include "model/edit/placed_loads.hpp"

#include <map>
#include <span>
#include <vector>

namespace kaya {

class SharedLoads {
public:
    /// Takes the placed loads out of `whole`, the row of the block with its arms in global axes, and out of its histories.
    /// `turn`: from the axes of the block to global ones.
    SharedLoads(Model& model, Row block, Blocks& whole, const Mat3& turn);

    /// To pieces that have their share by volume of the rest of `whole`: the loads at their places, prescribed velocities, and their share
    /// of load histories without a place. `shapes` are those of the pieces.
    void give(Model& model, const std::vector<Row>& pieces, std::span<const Polyhedron> shapes) const;

private:
    BlockId block_;
    double volume_;
    std::vector<PlacedLoad> loads_;
    std::map<std::int32_t, double> factors_; ///< present values of the functions
};

} // namespace kaya
