// A beam element of two nodes, which stretches, bends and twists: docs/theory/beams-and-liners.md (1) to (5).
#pragma once

#include "mechanics/structures/element_motion.hpp"

#include <array>

namespace kaya {

/// Stiffnesses and strengths of a cross section. An infinite strength means no limit.
struct BeamSection {
    double axial = 0;                    ///< EA
    double bending_y = 0, bending_z = 0; ///< E times the second moments of area about the axes y and z
    double torsion = 0;                  ///< G times the torsion constant
    double yield_tension = 0, yield_compression = 0;
    double plastic_y = 0, plastic_z = 0; ///< moments
};

/// Plastic deformation.
struct BeamLoss {
    double extension = 0;
    std::array<double, 4>
        hinge{}; ///< rotations: about y at the first and the last node, about z at the first and the last
};

/// Forces without deformation: axial force, torsion, end moments as BeamForces::moment.
using BeamKept = std::array<double, 6>;

/// Current deformation of the element.
struct BeamMotion {
    Mat3 axes = Mat3::Identity(); ///< columns x, y, z
    double length = 0;
    double extension = 0, twist = 0;
    std::array<double, 4> bend{}; ///< rotations of the nodes against the chord, as BeamLoss::hinge
};

/// Inner forces on the section face towards the last node, in the element's axes.
struct BeamForces {
    double axial = 0, torsion = 0;
    std::array<double, 4> moment{}; ///< about y at the first and the last node, about z at the first and the last
    double shear_y = 0, shear_z = 0;
    bool stretches = false, hinges = false; ///< at a limit
};

/// `rest` are the axes at creation, `length` is the length without force.
BeamMotion beam_motion(const Mat3& rest, double length, const NodePose& first, const NodePose& last);

/// Elastic up to the strengths, perfectly plastic beyond; `loss` accumulates the plastic deformation.
BeamForces beam_forces(const BeamSection& section, double length, const BeamMotion& motion, BeamLoss& loss,
                       const BeamKept& kept = {});

/// Forces and moments on the nodes. Their sum is zero, and so is the sum of their moments about any point.
std::array<EndForce, 2> beam_ends(const BeamMotion& motion, const BeamForces& forces);

EndStiffness beam_end_stiffness(const BeamSection& section, double length);

} // namespace kaya
