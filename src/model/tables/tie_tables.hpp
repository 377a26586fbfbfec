// Tables of ties between joined zoned blocks. docs/theory/ties.md.
#pragma once

#include "model/tables/blocks.hpp"
#include "model/tables/column.hpp"

#include <array>
#include <cstdint>

namespace kaya {

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

} // namespace kaya
