// Cables: bolts and tendons across blocks, as bars between nodes that grout holds in the rock. docs/theory/cables.md.
#pragma once

#include "model/measure/structure_rows.hpp"
#include "model/tables/cable_tables.hpp"
#include "model/structures/rock_points.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

struct Model;

/// A straight cable to be made.
struct NewCable {
    Vec3 first = Vec3::Zero(), last = Vec3::Zero();
    std::int32_t segments = 10;
    std::int32_t property = 1;
    double tension = 0; ///< force in all bars when it is made
    bool anchor_first = false, anchor_last = false;
};

/// Makes it and places its nodes in the blocks. Returns its row. Its ends must differ.
Row make_cable(Model& model, const NewCable& wanted);

/// Gives each node the length of cable whose grout acts there: half of the bars to nodes of its block, and of those that leave its block the part that
/// lies in it. The nodes must be placed.
void share_bars(Model& model, Row cable);

/// Removes cables, given by ascending rows.
void delete_cables(Model& model, const std::vector<Row>& cables);

/// Gives new cables their tension. Their properties must be there.
void tighten_cables(Model& model);

/// Force in the cable at a node: the mean of the bars on both sides; at an end that of its one bar.
double cable_force(const Model& model, Row node);

} // namespace kaya
