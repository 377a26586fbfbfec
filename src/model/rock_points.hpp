// Points of structures in the rock: their block and zone, and their present position.
#pragma once

#include "model/blocks.hpp"
#include "model/column.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace kaya {

struct Model;

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

/// Finds the block that holds a place. Boxes are made once: it is for many places of a model that does not change meanwhile.
class BlockFinder {
public:
    explicit BlockFinder(const Model& model);

    /// Among several, where blocks are in contact, the block whose centroid is nearest; no_row when the place is farther outside all blocks
    /// than `tolerance`, or than a millionth of a block's size if that is more.
    Row at(const Vec3& place, double tolerance = 0) const;
    /// Whether another block than `own` is nearer than that to a place.
    bool other_at(const Vec3& place, Row own, double tolerance) const;

private:
    struct Box {
        Vec3 low, high;
        double size;
    };
    template <class Visit> void each_near(const Vec3& place, double tolerance, const Visit& visit) const;

    const Model& model_;
    std::vector<Box> boxes_;
    double same_; ///< distances that differ by less are the same
};

/// Puts a row into the block and zone at its place.
void place_in_rock(const Model& model, const BlockFinder& finder, RockPoints& points, Row row, const Vec3& place,
                   double tolerance = 0);

/// The row of the containing block; no_row outside the rock.
Row rock_block(const Model& model, const RockPoints& points, Row row);

/// The number of rows inside the rock.
std::int32_t nodes_in_rock(const Model& model, const RockPoints& points, const Span& nodes);

/// Whether the block that it was placed in is still there, with the shape that it had then.
bool is_placed(const Model& model, const RockPoints& points, Row row);

/// Where it is now. It must be placed.
Vec3 rock_place(const Model& model, const RockPoints& points, Row row);

} // namespace kaya
