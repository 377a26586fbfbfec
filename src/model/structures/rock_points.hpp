// Points of structures in the rock: their block and zone, and their present position.
#pragma once

#include "model/measure/structure_rows.hpp"
#include "model/tables/rock_columns.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

struct Model;

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

/// Where it is now. It must be placed.
Vec3 rock_place(const Model& model, const RockPoints& points, Row row);

} // namespace kaya
