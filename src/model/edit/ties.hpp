// Ties between joined zoned blocks: docs/theory/ties.md.
#pragma once

#include "model/measure/covered_faces.hpp"
#include "model/tables/tie_tables.hpp"

#include <array>
#include <vector>

namespace kaya {

struct Model;

/// The rows of the two blocks of a pair; none when one was deleted, changed its shape, or they are no longer joined.
bool blocks_of_pair(const Model& model, Row pair, std::array<Row, 2>& blocks);

/// Which pairs of blocks have been checked; derived data.
class TiedBlocks {
public:
    explicit TiedBlocks(const Model& model);
    bool contains(Row a, Row b) const;

private:
    std::vector<std::array<Row, 2>> pairs_; ///< the lower row first, sorted
};

/// The faces on which another block of the same body is tied, as ascending rows.
std::vector<Row> tied_faces(const Model& model);

/// The same faces in pairs.
std::vector<FacePair> tied_face_pairs(const Model& model);

/// Removes void pairs. A body that has lost a block is separated where no tie is left.
void drop_void_ties(Model& model);

} // namespace kaya
