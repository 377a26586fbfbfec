#include "two_bricks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kaya {
namespace {

using test::Bench;

// The two bricks with known results of 3DEC: one offset on the other, rigid.
TEST(Cycle, AnOffsetBrickOnABrickRestsWithItsWeightAndMomentOnTheJoint) {
    Bench bench;
    bench.elastic(1, 2200, 0, 0);
    bench.elastic(2, 1000, 0, 0);
    const double x = 0.2746052742;
    const Row base = bench.brick({0, 0, 0}, {1, 1, 1}, 1);
    bench.brick({x, 0, 1}, {1 + x, 1, 2}, 2);
    fix_blocks(bench.model, {base});
    bench.model.settings.gravity = {0, 0, -9.806};
    bench.joint("mohr", {{"stiffness-normal", 9e10}, {"stiffness-shear", 5e10}, {"friction", 35}});
    ASSERT_EQ(bench.model.contacts.size(), 1u);
    EXPECT_NEAR(bench.area(), 1 - x, 1e-12);
    EXPECT_TRUE(bench.model.contacts.normal[0].isApprox(Vec3(0, 0, -1)));

    bench.run(4000);
    EXPECT_NEAR(bench.normal_force(), 9806, 1e-3);
    double moment = 0; // about y, of the support about the centre of the brick
    for (std::size_t s = 0; s < bench.model.sub_contacts.size(); ++s)
        moment += bench.model.sub_contacts.normal_force[s] * (bench.model.sub_contacts.position[s].x() - 0.5 - x);
    EXPECT_NEAR(moment, 0, 1);
}

TEST(Cycle, AFreeBlockFallsAsTheLeapFrogDoes) {
    Bench bench;
    bench.elastic(1, 2000, 0, 0);
    const Row b = bench.brick({0, 0, 0}, {1, 1, 1});
    bench.model.settings.gravity = {0, 0, -9.81};
    bench.model.settings.damping = Damping::none;
    bench.run(1000);
    const double t = bench.model.clock.time, dt = bench.model.clock.time_step;
    const double expected = 0.5 * 9.81 * t * t + 0.5 * 9.81 * dt * t;
    EXPECT_NEAR(-bench.model.blocks.displacement[b].z(), expected, 1e-11 * expected);
}

TEST(Cycle, FreeSpinAboutTheUnstableAxisKeepsMomentumAndEnergy) {
    Bench bench;
    bench.elastic(1, 2000, 0, 0);
    const Row b = bench.brick({0, 0, 0}, {1, 2, 3});
    auto& blocks = bench.model.blocks;
    bench.model.settings.damping = Damping::none;
    bench.model.settings.given_time_step = 1e-2;
    bench.cycle.prepare();
    const Mat3 inertia = blocks.inertia[b] * 2000;
    const Vec3 w0(1e-3, 1, 1e-3);
    blocks.rotational_velocity[b] = w0;
    blocks.angular_momentum[b] = inertia * w0;
    const Vec3 momentum = blocks.angular_momentum[b];
    const double energy = 0.5 * w0.dot(momentum);
    double least = 1e300, most = 0;
    for (int i = 0; i < 200000; ++i) { // 318 rotations
        bench.cycle.advance();
        const double e = 0.5 * blocks.rotational_velocity[b].dot(blocks.angular_momentum[b]);
        least = std::min(least, e);
        most = std::max(most, e);
    }
    EXPECT_EQ(blocks.angular_momentum[b], momentum);
    EXPECT_NEAR(least / energy, 1, 1e-4);
    EXPECT_NEAR(most / energy, 1, 1e-4);
    EXPECT_NEAR(blocks.orientation[b].norm(), 1, 1e-12);
}

// A uniform stress over a joint between two different meshes is in equilibrium from the first cycle.
TEST(Cycle, UniformStressAcrossAJointOfTwoMeshesIsInEquilibriumAtOnce) {
    Bench bench;
    bench.elastic(1, 2500, 4e9, 3e9);
    const Row low = bench.brick({0, 0, 0}, {1, 1, 1}), high = bench.brick({0, 0, 1}, {1, 1, 2});
    generate_zones(bench.model, {low}, 0.34);
    generate_zones(bench.model, {high}, 0.5);
    bench.joint("mohr", {{"jkn", 1e10}, {"jks", 5e9}, {"jfric", 45}});
    for (auto& s : bench.model.zones.stress) s << 0, 0, -1e6, 0, 0, 0;
    for (std::size_t s = 0; s < bench.model.sub_contacts.size(); ++s)
        bench.model.sub_contacts.normal_force[s] = 1e6 * bench.model.sub_contacts.area[s];
    StressField stress;
    stress.at_origin << 0, 0, -1e6, 0, 0, 0;
    std::vector<Row> ends;
    for (Row g = 0; g < static_cast<Row>(bench.model.gridpoints.size()); ++g) {
        const double z = bench.model.gridpoints.position[g].z();
        if (z == 0 || z == 2) ends.push_back(g);
    }
    EXPECT_NEAR(add_stress(bench.model, ends, stress), 2, 1e-12);
    bench.run(1);
    EXPECT_LT(bench.model.clock.maximum_ratio, 1e-10);
    EXPECT_NEAR(bench.area(), 1, 1e-12);
}

} // namespace
} // namespace kaya
