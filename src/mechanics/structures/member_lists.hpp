// Derived data of beams and liners, never saved: shapes of elements, and which elements act on which nodes.
#pragma once

#include "mechanics/structures/beam_element.hpp"
#include "mechanics/common/row_lists.hpp"
#include "mechanics/structures/shell_element.hpp"
#include "model/structures/members.hpp"
#include "model/tables/model.hpp"

#include <limits>
#include <vector>

namespace kaya {

struct MemberLists {
    struct Beam {
        BeamSection section;
        Mat3 axes; ///< when it was made
        double length;
    };
    std::vector<Beam> beams;
    std::vector<ShellShape> shells;
    Lists<Row> ends_of_node;    ///< by node of a member: rows of `ends`
    std::vector<EndForce> ends; ///< two for each beam element, and then three for each of liners
    std::vector<NodePose> poses;
    std::vector<Hold> holds;

    MemberLists() = default;
    /// Requires complete properties.
    explicit MemberLists(const Model& model);

    bool any() const { return !holds.empty(); }
};

NodePose pose_of(const MemberNodes& nodes, Row node);
BeamSection section_of_beam(const StructureProperties& properties);
ShellSection section_of_liner(const StructureProperties& properties);

/// Masses of nodes from the densities of their members, and bounds of their stiffnesses. Requires complete properties.
void compute_member_masses(Model& model);

/// Stiffness of the springs between a node and the rock.
struct LinkStiffness {
    double normal = 0, shear = 0;
};
LinkStiffness link_stiffness(const Model& model, Row node, Hold hold);

/// Bound of the stiffness of a free node, by equation (14) of docs/theory/beams-and-liners.md. Its link counts twice, since the rock moves
/// too.
double node_resistance(const Model& model, Row node, Hold hold);

/// The largest step that is stable for nodes with their own masses, and the node that sets it.
struct MemberLimit {
    double stable = std::numeric_limits<double>::infinity();
    Row node = no_row;
};
MemberLimit member_limit(const Model& model);

/// Whether inertial masses of nodes are fitted to the time step, as in static solution, instead of the step to the masses.
bool member_masses_follow(const Settings& settings);

} // namespace kaya
