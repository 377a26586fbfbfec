#include "mechanics/structures/beam_element.hpp"

namespace kaya {

namespace {

/// Moments at both ends of an element that bends about one axis.
struct BendingPair {
    double first, last;
    bool flows = false;
};

/// Moments within the limit nearest to the elastic ones in the norm of the compliance; the excess becomes hinge rotation.
BendingPair bend(double stiffness, double limit, const BendingPair& kept, double bend_first, double bend_last,
                 double& hinge_first, double& hinge_last) {
    const double a = bend_first - hinge_first, b = bend_last - hinge_last;
    const BendingPair elastic{stiffness * (4 * a + 2 * b) + kept.first, stiffness * (2 * a + 4 * b) + kept.last};
    const bool beyond_first = std::abs(elastic.first) > limit, beyond_last = std::abs(elastic.last) > limit;
    if (!beyond_first && !beyond_last) return elastic;
    BendingPair m = elastic;
    m.flows = true;
    // A hinge at one end relieves the other end by half of its moment.
    const double at_first = std::copysign(limit, elastic.first), at_last = std::copysign(limit, elastic.last);
    const double other_last = elastic.last - 0.5 * (elastic.first - at_first);
    const double other_first = elastic.first - 0.5 * (elastic.last - at_last);
    if (beyond_first && std::abs(other_last) <= limit) {
        m.first = at_first;
        m.last = other_last;
    } else if (beyond_last && std::abs(other_first) <= limit) {
        m.first = other_first;
        m.last = at_last;
    } else { // the greater one decides, and the other follows it
        const bool by_first = std::abs(elastic.first) >= std::abs(elastic.last);
        m.first = by_first ? at_first : std::copysign(limit, other_first);
        m.last = by_first ? std::copysign(limit, other_last) : at_last;
    }
    // The excess of the elastic moments, by the inverse of (4 2; 2 4).
    const double rest_first = (elastic.first - m.first) / (6 * stiffness),
                 rest_last = (elastic.last - m.last) / (6 * stiffness);
    hinge_first += 2 * rest_first - rest_last;
    hinge_last += 2 * rest_last - rest_first;
    return m;
}

} // namespace

BeamMotion beam_motion(const Mat3& rest, double length, const NodePose& first, const NodePose& last) {
    BeamMotion motion;
    const Vec3 chord = last.place - first.place;
    motion.length = chord.norm();
    motion.extension = motion.length - length;
    const Vec3 x = chord / motion.length;
    // The y axis is halfway between those of the two nodes, normal to the chord: each node sees half of a twist.
    const Mat3 at_first = first.turn * rest, at_last = last.turn * rest;
    const Vec3 between = at_first.col(1) + at_last.col(1);
    const Vec3 y = (between - between.dot(x) * x).normalized();
    motion.axes << x, y, x.cross(y);
    const Vec3 a = rotation_vector(motion.axes.transpose() * at_first),
               b = rotation_vector(motion.axes.transpose() * at_last);
    motion.twist = b[0] - a[0];
    motion.bend = {a[1], b[1], a[2], b[2]};
    return motion;
}

BeamForces beam_forces(const BeamSection& section, double length, const BeamMotion& motion, BeamLoss& loss,
                       const BeamKept& kept) {
    BeamForces forces;
    const double stiffness = section.axial / length,
                 elastic = stiffness * (motion.extension - loss.extension) + kept[0];
    forces.axial = std::clamp(elastic, -section.yield_compression, section.yield_tension);
    forces.stretches = forces.axial != elastic;
    if (forces.stretches) loss.extension += (elastic - forces.axial) / stiffness;
    forces.torsion = section.torsion / length * motion.twist + kept[1];
    auto& hinge = loss.hinge;
    const auto& turn = motion.bend;
    // The element acts on its first node with minus `first`: the section there faces the other way.
    const BendingPair y =
        bend(section.bending_y / length, section.plastic_y, {-kept[2], kept[3]}, turn[0], turn[1], hinge[0], hinge[1]);
    const BendingPair z =
        bend(section.bending_z / length, section.plastic_z, {-kept[4], kept[5]}, turn[2], turn[3], hinge[2], hinge[3]);
    forces.hinges = y.flows || z.flows;
    forces.moment = {-y.first, y.last, -z.first, z.last};
    forces.shear_y = -(z.first + z.last) / motion.length;
    forces.shear_z = (y.first + y.last) / motion.length;
    return forces;
}

std::array<EndForce, 2> beam_ends(const BeamMotion& motion, const BeamForces& forces) {
    const auto& m = forces.moment;
    const Vec3 force = motion.axes * Vec3(forces.axial, forces.shear_y, forces.shear_z);
    return {EndForce{force, motion.axes * Vec3(forces.torsion, m[0], m[2])},
            EndForce{-force, motion.axes * Vec3(-forces.torsion, -m[1], -m[3])}};
}

EndStiffness beam_end_stiffness(const BeamSection& section, double length) {
    // Deformations: extension, twist, and the rotations of both ends against the chord about y and z.
    Eigen::MatrixXd g = Eigen::MatrixXd::Zero(6, 12);
    g(0, 6) = g(1, 9) = 1;
    g(0, 0) = g(1, 3) = -1;
    const double by_length = 1 / length;
    for (const int end : {0, 1}) {
        g(2 + end, 4 + 6 * end) = g(4 + end, 5 + 6 * end) = 1;
        g(2 + end, 8) = g(4 + end, 1) = by_length;
        g(2 + end, 2) = g(4 + end, 7) = -by_length;
    }
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(6, 6);
    k(0, 0) = section.axial / length;
    k(1, 1) = section.torsion / length;
    const auto bending = [&](int at, double stiffness) {
        k(at, at) = k(at + 1, at + 1) = 4 * stiffness / length;
        k(at, at + 1) = k(at + 1, at) = 2 * stiffness / length;
    };
    bending(2, section.bending_y);
    bending(4, section.bending_z);
    return end_stiffness(g, k, 0.5 * length);
}

} // namespace kaya
