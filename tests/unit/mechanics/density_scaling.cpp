#include "model/measure/time_step_fraction.hpp"
#include "two_bricks.hpp"

#include "mechanics/step/density_scaling.hpp"
#include "mechanics/step/step_bounds.hpp"
#include "model/edit/joined.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kaya {
namespace {

using test::Bench;

/// A brick of 4 m on the ground and one of 5 cm next to it.
struct BigAndSmall : Bench {
    Row ground, big, small;

    BigAndSmall() {
        elastic(1, 2000, 0, 0);
        ground = brick({0, 0, 0}, {10, 4, 1});
        big = brick({0, 0, 1}, {4, 4, 5});
        small = brick({6, 1, 1}, {6.05, 1.05, 1.05});
        fix_blocks(model, {ground});
        model.settings.gravity = {0, 0, -10};
        joint("mohr", {{"stiffness-normal", 1e9}, {"stiffness-shear", 1e9}, {"friction", 30}});
    }
    void scale(MassScaling how, double step = 0) {
        model.settings.mass_scaling = how;
        model.settings.scaled_time_step = step;
        ModelEdit(model, Change::properties);
    }
    /// Cycles until all bodies are balanced, at most `most`.
    int settle(int most) {
        for (int n = 1; n <= most; ++n) {
            cycle.advance();
            if (model.clock.local_ratio < 1e-6) return n;
        }
        return most;
    }
    double force_on(Row block) const { return model.blocks.force[block].z(); }
};

TEST(DensityScaling, BodiesOfVeryDifferentSizeComeToRestInFarFewerCyclesWithTheSameForces) {
    BigAndSmall plain, scaled;
    scaled.scale(MassScaling::full);
    const int without = plain.settle(20000), with = scaled.settle(20000);
    EXPECT_LT(without, 20000);
    EXPECT_LT(5 * with, without);
    for (BigAndSmall* bench : {&plain, &scaled}) {
        EXPECT_NEAR(bench->force_on(bench->big), 64 * 2000 * 10, 1e-5 * 64 * 2000 * 10);
        EXPECT_NEAR(bench->force_on(bench->small), 1.25e-4 * 2000 * 10, 1e-5 * 1.25e-4 * 2000 * 10);
    }
    const auto& blocks = scaled.model.blocks;
    EXPECT_NEAR(blocks.mass[scaled.small], 0.25, 1e-12);
    EXPECT_GT(blocks.inertial_mass[scaled.small], 2.5);
}

TEST(DensityScaling, FullScalingGivesAllBodiesTheSameStep) {
    BigAndSmall bench;
    bench.scale(MassScaling::full);
    bench.cycle.prepare();
    const Adjacency adjacency = make_adjacency(bench.model);
    StepBounds bounds;
    bounds.update(bench.model, adjacency);
    const BodyStiffness& stiffness = bounds.stiffness(bench.model, adjacency);
    const auto& mass = bench.model.blocks.inertial_mass;
    const double of_big = stiffness.of_block[bench.big].elastic / mass[bench.big];
    EXPECT_NEAR(stiffness.of_block[bench.small].elastic / mass[bench.small], of_big, 1e-12 * of_big);
    // The redistributed mass is the total mass.
    EXPECT_NEAR(mass[bench.big] + mass[bench.small], 128000.25, 1e-6);
    EXPECT_NEAR(bench.model.clock.time_step, time_step_fraction(bench.model.settings) * 2 / std::sqrt(of_big), 1e-12);
}

TEST(DensityScaling, PartialScalingAddsMassToBodiesWithAShortStepOnlyAndReportsIt) {
    BigAndSmall plain, bench;
    plain.cycle.prepare();
    const double before = plain.model.clock.time_step, wanted = 3 * before;
    bench.scale(MassScaling::partial, wanted);
    bench.cycle.prepare();
    EXPECT_NEAR(bench.model.clock.time_step, wanted, 1e-9 * wanted);
    const auto& blocks = bench.model.blocks;
    EXPECT_EQ(blocks.inertial_mass[bench.big], blocks.mass[bench.big]);
    // Both bounds agree for a block on fixed ground, so the mass is proportional to the square of the step.
    EXPECT_NEAR(blocks.inertial_mass[bench.small], 9 * 0.25, 1e-9);
    const ScaledMasses sums = scaled_masses(bench.model);
    EXPECT_EQ(sums.bodies, 2u);
    EXPECT_EQ(sums.scaled, 1u);
    EXPECT_NEAR(sums.inertial - sums.real, 2.0, 1e-9);
}

TEST(DensityScaling, PartialScalingForAStepThatAllBodiesAllowChangesNothing) {
    BigAndSmall plain, bench;
    plain.cycle.prepare();
    bench.scale(MassScaling::partial, 0.99 * plain.model.clock.time_step);
    plain.run(50);
    bench.run(50);
    EXPECT_EQ(bench.model.clock.time_step, plain.model.clock.time_step);
    EXPECT_EQ(bench.model.blocks.velocity[bench.small], plain.model.blocks.velocity[plain.small]);
    EXPECT_EQ(scaled_masses(bench.model).scaled, 0u);
}

TEST(DensityScaling, ALandingBlockGetsTheMassThatTheStepRequires) {
    BigAndSmall bench;
    bench.model.settings.damping = Damping::none;
    bench.brick({8, 1, 1.02}, {8.05, 1.05, 1.07});
    bench.scale(MassScaling::full);
    const Row falling = 3;
    bench.cycle.prepare();
    EXPECT_EQ(bench.model.blocks.inertial_mass[falling], bench.model.blocks.mass[falling]);
    bench.model.settings.damping = Damping::local;
    for (int i = 0; i < 3000; ++i) {
        bench.cycle.advance();
        ASSERT_LT(bench.model.blocks.velocity[falling].norm(), 2) << "cycle " << i;
    }
    EXPECT_GT(bench.model.blocks.inertial_mass[falling], 2.5);
    EXPECT_NEAR(bench.force_on(falling), 2.5, 1e-3);
}

TEST(DensityScaling, AHeavierBodyKeepsItsMomentumALighterOneItsVelocityAndTheAccountOfEnergyCloses) {
    BigAndSmall bench;
    bench.model.settings.time_step_fraction = 0.05; // the account is of second order in the step
    bench.model.settings.energy = true;
    bench.run(50);
    auto& blocks = bench.model.blocks;
    const Vec3 spin(0.01, 0.02, 0.03), momentum = blocks.inertia[bench.small] * 2000 * spin;
    blocks.rotational_velocity[bench.small] = spin;
    blocks.angular_momentum[bench.small] = momentum;
    bench.cycle.advance(); // the account includes the set velocity
    const auto kinetic = [&](Row b) {
        return 0.5 * blocks.inertial_mass[b] * blocks.velocity[b].squaredNorm() +
               0.5 * blocks.rotational_velocity[b].dot(blocks.angular_momentum[b]);
    };
    const Vec3 small = blocks.velocity[bench.small], turning = blocks.angular_momentum[bench.small],
               big = blocks.velocity[bench.big];
    const double of_small = kinetic(bench.small), of_big = kinetic(bench.big), damped = bench.model.energy.damped;
    bench.scale(MassScaling::full);
    bench.cycle.prepare();
    const double factor = blocks.inertial_mass[bench.small] / blocks.mass[bench.small];
    ASSERT_GT(factor, 1);
    ASSERT_LT(blocks.inertial_mass[bench.big], blocks.mass[bench.big]);
    EXPECT_TRUE(blocks.velocity[bench.small].isApprox(small / factor, 1e-12));
    EXPECT_EQ(blocks.angular_momentum[bench.small], turning);
    EXPECT_EQ(blocks.velocity[bench.big], big);
    EXPECT_LT(kinetic(bench.small), of_small);
    EXPECT_LT(kinetic(bench.big), of_big);
    EXPECT_GT(bench.model.energy.damped, damped);
    EXPECT_LT(std::abs(bench.model.energy.error()), 1e-3 * std::abs(bench.model.energy.gravity));
    bench.run(2000);
    EXPECT_LT(std::abs(bench.model.energy.error()), 1e-3 * std::abs(bench.model.energy.gravity));
    restore_masses(bench.model);
    EXPECT_EQ(blocks.inertial_mass, blocks.mass);
}

TEST(DensityScaling, VelocitiesThatAreHeldStayWhenMassesChange) {
    BigAndSmall bench;
    bench.run(5);
    auto& blocks = bench.model.blocks;
    blocks.fixed[bench.small] = fix_x | fix_rz;
    blocks.velocity[bench.small] = {0.1, 0.2, 0};
    blocks.rotational_velocity[bench.small] = {0, 0, 0.3};
    bench.scale(MassScaling::full);
    bench.cycle.prepare();
    ASSERT_GT(blocks.inertial_mass[bench.small], blocks.mass[bench.small]);
    EXPECT_EQ(blocks.velocity[bench.small].x(), 0.1);
    EXPECT_LT(blocks.velocity[bench.small].y(), 0.2);
    EXPECT_EQ(blocks.rotational_velocity[bench.small].z(), 0.3);
}

TEST(DensityScaling, BlocksThatRattleInAGapGainNothing) {
    BigAndSmall bench;
    bench.model.settings.damping = Damping::none;
    bench.model.settings.gravity.setZero();
    bench.brick({6, 1, 1.3}, {6.05, 1.05, 2}); // above the small one, and fixed
    fix_blocks(bench.model, {bench.small, Row{3}});
    const Row rattling = bench.brick({6.001, 1.001, 1.06}, {6.04, 1.04, 1.16});
    bench.scale(MassScaling::full);
    bench.cycle.prepare();
    auto& blocks = bench.model.blocks;
    blocks.velocity[rattling] = {0, 0, 0.5};
    const double before = 0.5 * blocks.inertial_mass[rattling] * 0.25;
    for (int i = 0; i < 20000; ++i) {
        bench.cycle.advance();
        ASSERT_LT(0.5 * blocks.inertial_mass[rattling] * blocks.velocity[rattling].squaredNorm(), 1.01 * before)
            << "cycle " << i;
    }
}

TEST(DensityScaling, JoinedBlocksMoveAsTheOneBlockThatTheyMake) {
    const auto stand = [](bool joined) {
        auto bench = std::make_unique<BigAndSmall>();
        bench->scale(MassScaling::full);
        if (joined) {
            const Row low = bench->brick({8, 1, 1}, {9, 2, 1.4}), high = bench->brick({8, 1, 1.4}, {9, 2, 2});
            join_pairs(bench->model, {{low, high}});
        } else {
            bench->brick({8, 1, 1}, {9, 2, 2});
        }
        bench->run(500);
        return bench;
    };
    const auto whole = stand(false), parts = stand(true);
    const auto& a = whole->model.blocks;
    const auto& b = parts->model.blocks;
    EXPECT_NEAR(parts->model.clock.time_step / whole->model.clock.time_step, 1, 1e-9);
    EXPECT_NEAR((b.inertial_mass[3] + b.inertial_mass[4]) / a.inertial_mass[3], 1, 1e-9);
    EXPECT_NEAR(b.inertial_mass[3] / b.mass[3], b.inertial_mass[4] / b.mass[4], 1e-12);
    EXPECT_LT(std::abs(a.inertial_mass[3] / a.mass[3] - 1), 50);
    EXPECT_GT(std::abs(a.inertial_mass[3] / a.mass[3] - 1), 0.5);
    EXPECT_NEAR(b.displacement[4].z() / a.displacement[3].z(), 1, 1e-6);
    EXPECT_NEAR(b.force[3].z() + b.force[4].z(), 20000, 0.2);
}

TEST(DensityScaling, ZonesOfVeryDifferentSizeRestUnderTheirWeightInFewerCycles) {
    struct Zoned : Bench {
        Row big, small;
        explicit Zoned(MassScaling how) {
            elastic(1, 2000, 1e9, 6e8);
            big = brick({0, 0, 0}, {2, 2, 2});
            small = brick({3, 0, 0}, {3.1, 0.1, 0.1});
            generate_zones(model, {big}, 1.0);
            generate_zones(model, {small}, 0.1);
            model.settings.gravity = {0, 0, -10};
            model.settings.mass_scaling = how;
            std::vector<Row> bottom;
            for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
                if (model.gridpoints.position[g].z() == 0) bottom.push_back(static_cast<Row>(g));
            for (int k = 0; k < 3; ++k) prescribe_velocity(model, {{}, bottom}, k, 0);
        }
        int settle() {
            int cycles = 0;
            do cycle.advance();
            while (model.clock.average_ratio > 1e-6 && ++cycles < 20000);
            return cycles;
        }
        /// Mean displacement of the top of a block.
        double settlement(Row block, double top) const {
            double sum = 0;
            int count = 0;
            for (const Row g : gridpoints_of(block))
                if (std::abs(model.gridpoints.position[g].z() - top) < 1e-3) {
                    sum -= model.gridpoints.displacement[g].z();
                    ++count;
                }
            return sum / count;
        }
    };
    Zoned plain(MassScaling::none), scaled(MassScaling::full);
    const int without = plain.settle(), with = scaled.settle();
    EXPECT_LT(without, 20000);
    EXPECT_LT(5 * with, without);
    EXPECT_GT(plain.settlement(plain.big, 2), 0);
    EXPECT_NEAR(scaled.settlement(scaled.big, 2) / plain.settlement(plain.big, 2), 1, 1e-4);
    EXPECT_NEAR(scaled.settlement(scaled.small, 0.1) / plain.settlement(plain.small, 0.1), 1, 1e-3);
}

} // namespace
} // namespace kaya
