// Tables of cables and of their nodes. docs/theory/cables.md.
#pragma once

#include "model/tables/rock_columns.hpp"

namespace kaya {

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
    Column<double> slip_lost;      ///< at which the grout has no force
    Column<double> grout;          ///< force of the rock on the cable along it
    Column<std::uint8_t> grout_state;
    Column<Vec3> force;        ///< on the rock
    Column<double> bar_length; ///< without force
    Column<double> bar_yield;  ///< plastic elongation
    Column<double> bar_kept;   ///< force without elongation: what stayed when the stiffness changed
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
        visit("bar_kept", bar_kept, Role::state);
        visit("bar_force", bar_force, Role::state);
        visit("bar_state", bar_state, Role::state);
    }
};

} // namespace kaya
