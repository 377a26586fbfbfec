// Cables: bolts and tendons across blocks, as bars between nodes that grout holds in the rock. docs/theory/cables.md.
#pragma once

#include "model/blocks.hpp"
#include "model/column.hpp"
#include "model/rock_points.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

struct Model;

/// Bits of states of bars, grout, elements and links: now, or at any time before.
enum YieldState : std::uint8_t { yields = 1, has_yielded = 2, broken = 4 };

class CableNodes;

class Cables : public Table<Cables> {
public:
    Column<std::int32_t> number;   ///< what users see
    Column<std::int32_t> property; ///< key of Structures::properties
    Column<Span> nodes;            ///< contiguous and in the order of cables
    Column<double> tension;        ///< applied to its bars when its properties are known; 0 afterwards
    Column<double> work;           ///< done on the cable by the rock: stored in it or lost

    template <class Visit> void columns(Visit&& visit) {
        visit("number", number, Role::identity);
        visit("property", property, Role::setting);
        visit("nodes", nodes, link<CableNodes>());
        visit("tension", tension, Role::state);
        visit("work", work, Role::state);
    }
};

/// Places of a cable, and of each the bar to the next one; the last node of a cable has none.
class CableNodes : public Table<CableNodes>, public RockPoints {
public:
    Column<Row> cable;
    Column<std::uint8_t> anchored; ///< cannot slip
    Column<Vec3> position;         ///< of the rock at the node
    Column<double> share;          ///< length of cable whose grout acts at the node
    Column<double> slip;           ///< of the cable past the rock, towards its end
    Column<double> slip_lost;      ///< plastic part of it
    Column<double> grout;          ///< force of the rock on the cable along it
    Column<std::uint8_t> grout_state;
    Column<Vec3> force;        ///< on the rock
    Column<double> bar_length; ///< without force
    Column<double> bar_yield;  ///< plastic elongation
    Column<double> bar_force;  ///< tension positive
    Column<std::uint8_t> bar_state;

    template <class Visit> void columns(Visit&& visit) {
        visit("cable", cable, link<Cables>());
        rock_columns(visit);
        visit("anchored", anchored, Role::setting);
        visit("position", position, Role::geometry);
        visit("share", share, Role::geometry);
        visit("slip", slip, Role::state);
        visit("slip_lost", slip_lost, Role::state);
        visit("grout", grout, Role::state);
        visit("grout_state", grout_state, Role::state);
        visit("force", force, Role::state);
        visit("bar_length", bar_length, Role::geometry);
        visit("bar_yield", bar_yield, Role::state);
        visit("bar_force", bar_force, Role::state);
        visit("bar_state", bar_state, Role::state);
    }
};

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

/// Removes cables, given by ascending rows.
void delete_cables(Model& model, const std::vector<Row>& cables);

/// Gives new cables their tension. Their properties must be there.
void tighten_cables(Model& model);

/// The row of the block that contains a node; no_row outside the rock.
Row block_of_node(const Model& model, Row node);

/// The row of a cable's node, counted from its first; no_row when there is none.
Row node_of_cable(const Model& model, std::int32_t number, Row offset);

/// Whether it has a bar to the next node; the last one of a cable has none.
bool has_bar(const CableNodes& nodes, Row node);

/// Force in the cable at a node: the mean of the bars on both sides; at an end that of its one bar.
double cable_force(const Model& model, Row node);

} // namespace kaya
