// A flat triangle that stretches in its plane and bends: docs/theory/beams-and-liners.md (6) to (11).
#pragma once

#include "mechanics/structures/element_motion.hpp"

#include <array>

namespace kaya {

/// Section of an isotropic elastic plate.
struct ShellSection {
    double thickness = 0, young = 0, poisson = 0;
    bool operator==(const ShellSection&) const = default;
};

/// Element data computed at creation from its corners and section.
struct ShellShape {
    ShellShape(const std::array<Vec3, 3>& corners, const ShellSection& section);

    Mat3 axes; ///< columns x, y, z; z is the normal, x along the first side
    double area = 0;
    Eigen::Matrix<double, 2, 3> gradients; ///< of the linear shape functions, in the plane
    Eigen::Matrix<double, 2, 3> places;    ///< of the corners from the first one, in the plane
    Mat3 membrane;                         ///< resultants by strains xx, yy, 2 xy
    Mat3 bending;                          ///< moments by curvatures xx, yy, 2 xy
    double drilling = 0;                   ///< moment by rotation of a node about the normal
    Eigen::Matrix<double, 6, 6> rotations; ///< moments by rotations of the corners x, y out of the plane
    std::array<Eigen::Matrix<double, 3, 6>, 3> curvatures; ///< at the middles of the sides, by the same rotations
};

/// Present deformation of the element, in its rotated axes.
struct ShellMotion {
    Mat3 axes = Mat3::Identity();
    Eigen::Matrix2d stretch;
    Vec3 strain;                      ///< xx, yy, 2 xy
    Eigen::Matrix<double, 6, 1> bend; ///< rotations of the corners x, y against the element
    Vec3 drill;                       ///< and about the normal
};

/// Columns: membrane, moments at the middles of the three sides, and moments of the nodes about the normal.
using ShellResultants = Eigen::Matrix<double, 3, 5>;

/// Present forces of the element, in its rotated axes.
struct ShellForces {
    Mat3 axes = Mat3::Identity();
    Vec3 membrane = Vec3::Zero(); ///< force per length: xx, yy, xy; tension positive
    Vec3 moment = Vec3::
        Zero(); ///< moment per length at the centroid: xx, yy, xy; positive with tension on the side of the normal
    std::array<EndForce, 3> ends; ///< on the nodes; their sum is zero, and so is that of their moments about any point
};

/// Strains and rotations relative to the element are small; its own motion may be large.
ShellMotion shell_motion(const ShellShape& shape, const std::array<NodePose, 3>& nodes);
ShellResultants shell_resultants(const ShellShape& shape, const ShellMotion& motion);
/// `kept` are the resultants without deformation.
ShellForces shell_forces(const ShellShape& shape, const std::array<NodePose, 3>& nodes, const ShellResultants& kept);

EndStiffness shell_end_stiffness(const ShellShape& shape);

} // namespace kaya
