// Common to elements of beams and liners: the pose of their nodes, their forces and their stiffness.
#pragma once

#include "base/vector.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kaya {

/// Present pose of a node.
struct NodePose {
    Vec3 place = Vec3::Zero();
    Mat3 turn = Mat3::Identity(); ///< since its creation
};

/// Force and moment of an element on one of its nodes.
struct EndForce {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

/// The rotation vector of a rotation of less than half a revolution.
inline Vec3 rotation_vector(const Mat3& turn) {
    const Vec3 sine =
        0.5 * Vec3(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)); // times the axis
    const double size = sine.norm();
    if (size < 1e-12) return sine;
    return (std::atan2(size, 0.5 * (turn.trace() - 1)) / size) * sine;
}

/// Stiffnesses of single nodes on fixed ground that together resist at least as much as the element: K <= diag(translation, rotation) for
/// each node.
struct EndStiffness {
    double translation = 0, rotation = 0;
};

/// `deformation` maps the motion of the nodes (three translations and three rotations each) to deformations, `stiffness` maps these to
/// generalised forces. A rotation counts as a translation at the distance `arm`.
EndStiffness end_stiffness(const Eigen::MatrixXd& deformation, const Eigen::MatrixXd& stiffness, double arm);

} // namespace kaya
