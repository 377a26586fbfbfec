// Edges of a block.
#pragma once

#include "model/tables/model.hpp"

#include <array>
#include <vector>

namespace kaya {

/// An edge between two faces of a block.
struct Edge {
    std::array<Row, 2> ends; ///< gridpoints
    std::array<Row, 2> faces;
};

/// Edges between faces (not those between triangles of one face), each once, in the order of their gridpoints.
void edges_of(const Model& model, Row block, std::vector<Edge>& edges);

} // namespace kaya
