#include "mechanics/structures/shell_element.hpp"

#include <Eigen/LU>

namespace kaya {

namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

/// Part of the shear stiffness that couples the nodes to the rotation of the element about its normal. It gives flat parts a stiffness
/// there; a uniform strain does not activate it.
constexpr double drilling_part = 0.01;

/// x along the first side, z across.
Mat3 triangle_axes(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 x = (b - a).normalized(), z = (b - a).cross(c - a).normalized();
    Mat3 axes;
    axes << x, z.cross(x), z;
    return axes;
}

/// Plane stress: stresses xx, yy, xy by strains xx, yy, 2 xy.
Mat3 plane_stress(const ShellSection& section) {
    const double poisson = section.poisson;
    Mat3 d;
    d << 1, poisson, 0, poisson, 1, 0, 0, 0, 0.5 * (1 - poisson);
    return section.young / (1 - poisson * poisson) * d;
}

/// Curvatures at the middle of the side opposite to corner `across`, by the rotations x, y of the corners. Slopes are linear between the
/// corners; along a side they are those of a cubic that is 0 at both ends, so 3/2 of their mean is subtracted in its middle. This is the
/// triangle of Batoz, Bathe and Ho.
Eigen::Matrix<double, 3, 6> curvatures_at(const ShellShape& shape, int across) {
    const auto strain = [](const Vec2& slope, const Vec2& gradient) {
        return Vec3(slope[0] * gradient[0], slope[1] * gradient[1], slope[0] * gradient[1] + slope[1] * gradient[0]);
    };
    const auto& gradients = shape.gradients;
    const auto at = [&](int corner) { return corner == across ? 0.0 : 0.5; };
    Eigen::Matrix<double, 3, 6> rows;
    for (int corner = 0; corner < 3; ++corner)
        for (const int axis : {0, 1}) {
            const Vec2 slope = axis == 0 ? Vec2(0, 1) : Vec2(-1, 0); // of a unit rotation about x or y
            Vec3 sum = strain(slope, gradients.col(corner));
            for (int other = 0; other < 3; ++other) {
                if (other == corner) continue;
                const Vec2 side = (shape.places.col(other) - shape.places.col(corner)).normalized();
                const Vec2 bubble = 4 * (at(corner) * gradients.col(other) + at(other) * gradients.col(corner));
                sum += strain(-0.75 * side.dot(slope) * side, bubble);
            }
            rows.col(2 * corner + axis) = sum;
        }
    return rows;
}

} // namespace

ShellShape::ShellShape(const std::array<Vec3, 3>& corners, const ShellSection& section)
    : axes(triangle_axes(corners[0], corners[1], corners[2])) {
    const Eigen::Matrix<double, 2, 3> plane = axes.leftCols<2>().transpose();
    places << Vec2::Zero(), plane * (corners[1] - corners[0]), plane * (corners[2] - corners[0]);
    const Vec2 first = places.col(1), second = places.col(2);
    const double twice = first[0] * second[1] - first[1] * second[0];
    area = 0.5 * twice;
    gradients.col(1) = Vec2(second[1], -second[0]) / twice;
    gradients.col(2) = Vec2(-first[1], first[0]) / twice;
    gradients.col(0) = -gradients.col(1) - gradients.col(2);
    const Mat3 elastic = plane_stress(section);
    const double t = section.thickness;
    membrane = t * elastic;
    bending = t * t * t / 12 * elastic;
    drilling = drilling_part * membrane(2, 2) * area / 3;
    rotations.setZero();
    for (int k = 0; k < 3; ++k) {
        curvatures[static_cast<std::size_t>(k)] = curvatures_at(*this, k);
        const auto& rows = curvatures[static_cast<std::size_t>(k)];
        rotations += area / 3 * rows.transpose() * bending * rows;
    }
}

ShellMotion shell_motion(const ShellShape& shape, const std::array<NodePose, 3>& nodes) {
    ShellMotion motion;
    // The plane through the nodes; within it the rotation of the polar decomposition, so that the rest is a symmetric stretch.
    const Mat3 plane = triangle_axes(nodes[0].place, nodes[1].place, nodes[2].place);
    Mat2 gradient = Mat2::Zero();
    for (int k = 1; k < 3; ++k) {
        const Vec3 side = nodes[static_cast<std::size_t>(k)].place - nodes[0].place;
        gradient += Vec2(plane.col(0).dot(side), plane.col(1).dot(side)) * shape.gradients.col(k).transpose();
    }
    const double turn = std::atan2(gradient(1, 0) - gradient(0, 1), gradient(0, 0) + gradient(1, 1));
    const double c = std::cos(turn), s = std::sin(turn);
    motion.axes << c * plane.col(0) + s * plane.col(1), c * plane.col(1) - s * plane.col(0), plane.col(2);
    Mat2 back;
    back << c, s, -s, c;
    motion.stretch = back * gradient;
    const Mat2& stretch = motion.stretch;
    motion.strain = Vec3(stretch(0, 0) - 1, stretch(1, 1) - 1, stretch(0, 1) + stretch(1, 0));
    for (int k = 0; k < 3; ++k) {
        const Vec3 rotation =
            rotation_vector(motion.axes.transpose() * (nodes[static_cast<std::size_t>(k)].turn * shape.axes));
        motion.bend.segment<2>(2 * k) = rotation.head<2>();
        motion.drill[k] = rotation[2];
    }
    return motion;
}

ShellResultants shell_resultants(const ShellShape& shape, const ShellMotion& motion) {
    ShellResultants resultants;
    resultants.col(0) = shape.membrane * motion.strain;
    for (int k = 0; k < 3; ++k)
        resultants.col(1 + k) = -shape.bending * (shape.curvatures[static_cast<std::size_t>(k)] * motion.bend);
    resultants.col(4) = -shape.drilling * motion.drill;
    return resultants;
}

ShellForces shell_forces(const ShellShape& shape, const std::array<NodePose, 3>& nodes, const ShellResultants& kept) {
    const ShellMotion motion = shell_motion(shape, nodes);
    const Mat2& stretch = motion.stretch;
    ShellForces forces;
    forces.axes = motion.axes;
    const ShellResultants resultants = shell_resultants(shape, motion) + kept;
    forces.membrane = resultants.col(0);
    const Vec3 drilling = resultants.col(4);
    Eigen::Matrix<double, 6, 1> moments = Eigen::Matrix<double, 6, 1>::Zero();
    for (int k = 0; k < 3; ++k)
        moments += shape.area / 3 * shape.curvatures[static_cast<std::size_t>(k)].transpose() * resultants.col(1 + k);
    // Linear in the plane: the mean is the value at the centroid.
    forces.moment = (resultants.col(1) + resultants.col(2) + resultants.col(3)) / 3;

    // Forces across and in the plane that balance the moments of the nodes.
    const Vec2 sum(moments[0] + moments[2] + moments[4], moments[1] + moments[3] + moments[5]);
    const Vec2 across = stretch.inverse() * Vec2(sum[1], -sum[0]);
    const double about = -drilling.sum() / stretch.trace();
    Mat2 resultant;
    resultant << forces.membrane[0], forces.membrane[2], forces.membrane[2], forces.membrane[1];
    for (int k = 0; k < 3; ++k) {
        const Vec2 g = shape.gradients.col(k);
        const Vec2 in_plane = -shape.area * (resultant * g) + about * Vec2(-g[1], g[0]);
        auto& end = forces.ends[static_cast<std::size_t>(k)];
        end.force = forces.axes * Vec3(in_plane[0], in_plane[1], across.dot(g));
        end.moment = forces.axes * Vec3(moments[2 * k], moments[2 * k + 1], drilling[k]);
    }
    return forces;
}

EndStiffness shell_end_stiffness(const ShellShape& shape) {
    // Deformations: strains, rotations of the corners against the plane, and against its turn about the normal.
    Eigen::MatrixXd g = Eigen::MatrixXd::Zero(12, 18);
    for (int k = 0; k < 3; ++k) {
        const Vec2 n = shape.gradients.col(k);
        const int at = 6 * k;
        g(0, at) = g(2, at + 1) = n[0];
        g(1, at + 1) = g(2, at) = n[1];
        for (int corner = 0; corner < 3; ++corner) {
            g(3 + 2 * corner, at + 2) = -n[1];
            g(4 + 2 * corner, at + 2) = n[0];
            g(9 + corner, at) = 0.5 * n[1];
            g(9 + corner, at + 1) = -0.5 * n[0];
        }
        g(3 + 2 * k, at + 3) = g(4 + 2 * k, at + 4) = g(9 + k, at + 5) = 1;
    }
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(12, 12);
    stiffness.topLeftCorner<3, 3>() = shape.area * shape.membrane;
    stiffness.block<6, 6>(3, 3) = shape.rotations;
    stiffness.bottomRightCorner<3, 3>().diagonal().setConstant(shape.drilling);
    return end_stiffness(g, stiffness, 0.5 * std::sqrt(2 * shape.area));
}

} // namespace kaya
