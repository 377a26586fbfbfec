// One beam element: closed forms of Euler and Bernoulli, motions as a rigid body, balance, limits.
#include "mechanics/structures/beam_element.hpp"

#include "random_motions.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace kaya;
using namespace kaya::test;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

BeamSection section() {
    return {.axial = 3e6,
            .bending_y = 2e4,
            .bending_z = 5e4,
            .torsion = 1e4,
            .yield_tension = infinite,
            .yield_compression = infinite,
            .plastic_y = infinite,
            .plastic_z = infinite};
}

struct Bent {
    BeamMotion motion;
    BeamForces forces;
    std::array<EndForce, 2> ends;
};

/// An element along the x axis of `rest` whose last node has moved by a small motion; the whole is then rotated and moved.
Bent bent(const Mat3& rest, double length, const std::array<Vec3, 2>& shift, const std::array<Vec3, 2>& rotation,
          const Mat3& turn, const Vec3& far) {
    std::array<NodePose, 2> nodes;
    for (std::size_t k = 0; k < 2; ++k) {
        nodes[k].place = far + turn * rest * (Vec3(static_cast<double>(k) * length, 0, 0) + shift[k]);
        nodes[k].turn = turn * rest * turn_of(rotation[k]) * rest.transpose();
    }
    Bent result;
    BeamLoss none;
    result.motion = beam_motion(rest, length, nodes[0], nodes[1]);
    result.forces = beam_forces(section(), length, result.motion, none);
    result.ends = beam_ends(result.motion, result.forces);
    return result;
}

} // namespace

TEST(BeamElement, FeelsNoRigidMotion) {
    Random random(1);
    for (int k = 0; k < 100; ++k) {
        const std::array<Vec3, 2> none{Vec3::Zero(), Vec3::Zero()};
        const Bent b = bent(random.turn(), 2, none, none, random.turn(), random.vector(10));
        for (const auto& end : b.ends) {
            EXPECT_LT(end.force.norm(), 1e-7); // 3e6 and the precision of positions
            EXPECT_LT(end.moment.norm(), 1e-9);
        }
    }
}

TEST(BeamElement, HasTheForcesOfCantileversInAnyOrientation) {
    Random random(2);
    const double L = 2, P = 1e-3;
    const BeamSection s = section();
    for (int k = 0; k < 50; ++k) {
        const Mat3 rest = random.turn(), turn = random.turn(), axes = turn * rest;
        // P along y and then along z at the free end; the element exerts the opposite force on the node.
        Bent y = bent(rest, L, {Vec3::Zero(), Vec3(0, P * L * L * L / (3 * s.bending_z), 0)},
                      {Vec3::Zero(), Vec3(0, 0, P * L * L / (2 * s.bending_z))}, turn, random.vector(10));
        EXPECT_LT((y.ends[1].force - axes * Vec3(0, -P, 0)).norm(), 1e-4 * P);
        EXPECT_LT(y.ends[1].moment.norm(), 1e-4 * P * L);
        EXPECT_NEAR(y.forces.moment[2], P * L, 1e-4 * P * L);
        EXPECT_NEAR(y.forces.shear_y, P, 1e-4 * P);
        Bent z = bent(rest, L, {Vec3::Zero(), Vec3(0, 0, P * L * L * L / (3 * s.bending_y))},
                      {Vec3::Zero(), Vec3(0, -P * L * L / (2 * s.bending_y), 0)}, turn, random.vector(10));
        EXPECT_LT((z.ends[1].force - axes * Vec3(0, 0, -P)).norm(), 1e-4 * P);
        EXPECT_LT(z.ends[1].moment.norm(), 1e-4 * P * L);
        EXPECT_NEAR(z.forces.moment[0], -P * L, 1e-4 * P * L);
        EXPECT_NEAR(z.forces.shear_z, P, 1e-4 * P);
        // Tension and twist.
        Bent x = bent(rest, L, {Vec3::Zero(), Vec3(1e-6, 0, 0)}, {Vec3::Zero(), Vec3(1e-6, 0, 0)}, turn, Vec3::Zero());
        EXPECT_NEAR(x.forces.axial, s.axial / L * 1e-6, 1e-9 * s.axial);
        EXPECT_NEAR(x.forces.torsion, s.torsion / L * 1e-6, 1e-6);
        EXPECT_LT((x.ends[1].moment - axes * Vec3(-x.forces.torsion, 0, 0)).norm(), 1e-8);
    }
}

TEST(BeamElement, IsInBalanceHoweverItIsDeformed) {
    Random random(3);
    for (int k = 0; k < 200; ++k) {
        const Bent b = bent(random.turn(), 2, {random.vector(0.3), random.vector(0.3)},
                            {random.vector(0.5), random.vector(0.5)}, random.turn(), random.vector(3));
        const Vec3 chord = b.motion.length * b.motion.axes.col(0);
        EXPECT_LT((b.ends[0].force + b.ends[1].force).norm(), 1e-9 * b.ends[0].force.norm());
        EXPECT_LT((b.ends[0].moment + b.ends[1].moment + chord.cross(b.ends[1].force)).norm(),
                  1e-9 * (1 + b.ends[0].moment.norm()));
    }
}

TEST(BeamElement, KeepsHingesBelowTheirMoment) {
    Random random(4);
    const double L = 2;
    BeamSection limited = section();
    limited.plastic_y = 40;
    limited.plastic_z = 70;
    limited.yield_tension = 500;
    limited.yield_compression = 300;
    for (int k = 0; k < 500; ++k) {
        BeamMotion motion;
        motion.length = L;
        motion.extension = random(1e-3);
        for (double& turn : motion.bend) turn = random(0.01);
        BeamLoss loss;
        const BeamForces f = beam_forces(limited, L, motion, loss);
        EXPECT_LE(f.axial, 500);
        EXPECT_GE(f.axial, -300);
        EXPECT_NEAR(f.axial, limited.axial / L * (motion.extension - loss.extension), 1e-9);
        for (int axis = 0; axis < 2; ++axis) {
            const double limit = axis == 0 ? limited.plastic_y : limited.plastic_z;
            const double stiffness = (axis == 0 ? limited.bending_y : limited.bending_z) / L;
            const auto at = static_cast<std::size_t>(2 * axis);
            const double a = motion.bend[at] - loss.hinge[at], b = motion.bend[at + 1] - loss.hinge[at + 1];
            EXPECT_NEAR(-f.moment[at], stiffness * (4 * a + 2 * b), 1e-9 * limit);
            EXPECT_NEAR(f.moment[at + 1], stiffness * (2 * a + 4 * b), 1e-9 * limit);
            // A hinge rotates only where the moment is at its limit, and in its direction.
            for (const std::size_t end : {at, at + 1}) {
                const double moment = end == at ? -f.moment[end] : f.moment[end];
                EXPECT_LE(std::abs(moment), limit * (1 + 1e-12));
                EXPECT_GE(loss.hinge[end] * moment, -1e-12);
                if (std::abs(moment) < limit * (1 - 1e-9)) { EXPECT_NEAR(loss.hinge[end], 0, 1e-15); }
            }
        }
        BeamLoss again = loss;
        const BeamForces same = beam_forces(limited, L, motion, again);
        for (std::size_t m = 0; m < 4; ++m) EXPECT_NEAR(same.moment[m], f.moment[m], 1e-9 * limited.plastic_z);
    }
}

TEST(BeamElement, IsNoStifferThanItsBound) {
    Random random(5);
    const double L = 2, small = 1e-7;
    const EndStiffness bound = beam_end_stiffness(section(), L);
    double most = 0;
    for (int k = 0; k < 2000; ++k) {
        std::array<Vec3, 2> shift{small * random.vector(1), small * random.vector(1)},
            rotation{small * random.vector(1), small * random.vector(1)};
        if (k % 2) shift[1] = -shift[0];
        const Bent b = bent(Mat3::Identity(), L, shift, rotation, Mat3::Identity(), Vec3::Zero());
        double energy = 0, allowed = 0;
        for (std::size_t i = 0; i < 2; ++i) {
            energy -= b.ends[i].force.dot(shift[i]) + b.ends[i].moment.dot(rotation[i]);
            allowed += bound.translation * shift[i].squaredNorm() + bound.rotation * rotation[i].squaredNorm();
        }
        most = std::max(most, energy / allowed);
    }
    EXPECT_LE(most, 1 + 1e-5);
    EXPECT_GT(most, 0.5);
}
