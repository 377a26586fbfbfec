// Ties between joined zoned blocks: docs/theory/ties.md.
#pragma once

#include "model/blocks.hpp"
#include "model/column.hpp"

#include <array>
#include <utility>
#include <vector>

namespace kaya {

struct Model;

class Ties;

/// Pairs of joined zoned blocks whose surfaces have been checked: they have no contacts. Blocks are stored by id, so nothing is renamed
/// when rows move.
class TiedPairs : public Table<TiedPairs> {
public:
    Column<BlockId> block1, block2;
    Column<std::int32_t> shape1,
        shape2;        ///< Blocks::shape at that check; the pair is void when it has changed
    Column<Span> ties; ///< a pair's rows are contiguous and in the order of pairs; none without common faces
                       ///< each other

    template <class Visit> void columns(Visit&& visit) {
        visit("block1", block1, link<Blocks>());
        visit("block2", block2, link<Blocks>());
        visit("shape1", shape1, Role::identity);
        visit("shape2", shape2, Role::identity);
        visit("ties", ties, link<Ties>());
    }
};

/// One place where two faces of joined blocks are held together. Rows of gridpoints, faces and zones are
/// counted from the first of their block.
class Ties : public Table<Ties> {
public:
    Column<Row> pair;
    Column<std::uint8_t> exact; ///< two gridpoints that move as one; otherwise a spring between two triangles
    Column<Row> face1, face2;
    Column<std::array<Row, 3>> gridpoints1, gridpoints2; ///< of the triangle that holds the place
    Column<std::array<double, 3>> weights1, weights2;    ///< sum to 1; of an exact tie 1, 0, 0
    Column<Row> zone1, zone2;                            ///< behind the triangles
    Column<double> area;                                 ///< share of the common face
    Column<Vec3> force;                                  ///< of a spring on the second block, global axes
    Column<Vec3> dashpot;                                ///< additional viscous force, with damping

    template <class Visit> void columns(Visit&& visit) {
        visit("pair", pair, link<TiedPairs>());
        visit("exact", exact, Role::geometry);
        visit("face1", face1, Role::local_link);
        visit("face2", face2, Role::local_link);
        visit("gridpoints1", gridpoints1, Role::local_link);
        visit("gridpoints2", gridpoints2, Role::local_link);
        visit("weights1", weights1, Role::geometry);
        visit("weights2", weights2, Role::geometry);
        visit("zone1", zone1, Role::local_link);
        visit("zone2", zone2, Role::local_link);
        visit("area", area, Role::geometry);
        visit("force", force, Role::state);
        visit("dashpot", dashpot, Role::state);
    }
};

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

/// Removes void pairs. A body that has lost a block is separated where no tie is left.
void drop_void_ties(Model& model);

} // namespace kaya
