#include "test_joint.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace kaya {
namespace {

using test::shipped;
using test::TestJoint;
using test::Values;
using test::values_of;
using test::work_of_step;
using testing::HasSubstr;

double tan_degrees(double angle) { return std::tan(angle * std::numbers::pi / 180); }

constexpr double kn = 1e10, ks = 4e9;

TestJoint joint_of(Values more, double area = 1, std::size_t rows = 1) {
    more["stiffness-normal"] = kn;
    more["stiffness-shear"] = ks;
    return TestJoint(shipped("mohr"), more, area, rows);
}

TEST(Mohr, IsElasticBelowItsStrength) {
    auto joint = joint_of({{"friction", 30}, {"cohesion", 1e5}}, 0.25);
    joint.step(-1e-4, {1e-5, 2e-5, 0});
    EXPECT_DOUBLE_EQ(joint.normal_stress(), 1e6);
    EXPECT_DOUBLE_EQ(joint.shear_force[0][0], -ks * 0.25 * 1e-5);
    EXPECT_DOUBLE_EQ(joint.shear_force[1][0], -ks * 0.25 * 2e-5);
    EXPECT_EQ(joint.state[0], 0u);
    EXPECT_EQ(joint.frictional_work[0], 0);
}

TEST(Mohr, PeaksAtCohesionPlusFrictionAndFallsToTheResidual) {
    for (const double stress : {0.0, 2e5, 1e6, 7e6}) {
        auto joint = joint_of(
            {{"friction", 30}, {"cohesion", 1e5}, {"friction-residual", 20}, {"cohesion-residual", 2e4}}, 0.04);
        joint.load(stress);
        const double peak = 1e5 + stress * tan_degrees(30);
        double highest = 0;
        for (int k = 0; k < 3000; ++k) {
            joint.step(0, {1e-6 * (1 + stress / 1e6), 0, 0});
            highest = std::max(highest, joint.shear_stress());
        }
        EXPECT_NEAR(highest / peak, 1, 1e-12) << stress;
        EXPECT_NEAR(joint.shear_stress() / (2e4 + stress * tan_degrees(20)), 1, 1e-12) << stress;
        EXPECT_TRUE(joint.in_state("slip-now"));
        EXPECT_TRUE(joint.in_state("slip-past"));
    }
}

TEST(Mohr, ResidualsAreNoneAndTheSameFrictionWhenNotGiven) {
    auto joint = joint_of({{"friction", 35}, {"cohesion", 5e5}, {"tension", 1e5}});
    joint.load(1e6);
    for (int k = 0; k < 1000; ++k) joint.step(0, {0, 1e-6, 0});
    EXPECT_NEAR(joint.shear_stress() / (1e6 * tan_degrees(35)), 1, 1e-12);
    for (int k = 0; k < 200; ++k) joint.step(1e-6); // the tensile strength was lost with the cohesion
    EXPECT_EQ(joint.normal_force[0], 0);
}

TEST(Mohr, TheStrengthIsThatOfThePlaneInEveryDirection) {
    auto joint = joint_of({{"friction", 25}}, 1, 64);
    joint.load(1e6);
    for (std::size_t i = 0; i < 64; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 64;
        joint.normal_disp_inc[i] = 0;
        joint.shear_disp_inc[0][i] = 1e-3 * std::cos(angle);
        joint.shear_disp_inc[1][i] = 1e-3 * std::sin(angle);
    }
    auto batch = joint.batch();
    ASSERT_FALSE(run_batch(*joint.model, batch));
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_NEAR(joint.shear_stress(i) / (1e6 * tan_degrees(25)), 1, 1e-12);
        EXPECT_NEAR(joint.shear_force[0][i] * joint.shear_disp_inc[1][i],
                    joint.shear_force[1][i] * joint.shear_disp_inc[0][i], 1e-6);
        EXPECT_LT(joint.shear_force[0][i] * joint.shear_disp_inc[0][i] +
                      joint.shear_force[1][i] * joint.shear_disp_inc[1][i],
                  0);
    }
}

TEST(Mohr, EveryRowOfABatchGivesTheSameBits) {
    auto joint = joint_of({{"friction", 33}, {"cohesion", 1e5}, {"dilation", 8}, {"tension", 3e4}}, 0.3, 37);
    for (int k = 0; k < 300; ++k)
        joint.step(1e-5 * std::sin(0.05 * k), {1e-5 * std::cos(0.11 * k), 7e-6 * std::sin(0.17 * k), 0});
    for (std::size_t i = 1; i < 37; ++i) {
        EXPECT_EQ(joint.normal_force[i], joint.normal_force[0]);
        EXPECT_EQ(joint.shear_force[0][i], joint.shear_force[0][0]);
        EXPECT_EQ(joint.frictional_work[i], joint.frictional_work[0]);
        EXPECT_EQ(joint.state[i], joint.state[0]);
    }
}

TEST(Mohr, ReachesTheTensileStrengthAndThenCarriesNothing) {
    auto joint = joint_of({{"friction", 30}, {"cohesion", 1e6}, {"tension", 2e5}}, 0.5);
    double lowest = 0;
    for (int k = 0; k < 4000; ++k) {
        joint.step(1e-8, {1e-9, 0, 0});
        lowest = std::min(lowest, joint.normal_stress());
    }
    EXPECT_NEAR(lowest, -2e5, kn * 1e-8);
    EXPECT_GE(lowest, -2e5);
    EXPECT_EQ(joint.normal_force[0], 0);
    EXPECT_EQ(joint.shear_stress(), 0);
    EXPECT_TRUE(joint.in_state("tension-now"));
    joint.load(1e6); // closed again, without cohesion
    for (int k = 0; k < 1000; ++k) joint.step(0, {1e-6, 0, 0});
    EXPECT_NEAR(joint.shear_stress() / (1e6 * tan_degrees(30)), 1, 1e-12);
    EXPECT_TRUE(joint.in_state("tension-past"));
    EXPECT_FALSE(joint.in_state("tension-now"));
}

TEST(Mohr, KeepsAResidualTension) {
    auto joint = joint_of({{"friction", 30}, {"tension", 2e5}, {"tension-residual", 5e4}});
    for (int k = 0; k < 100; ++k) joint.step(1e-6);
    EXPECT_DOUBLE_EQ(joint.normal_stress(), -5e4);
    for (int k = 0; k < 100; ++k) joint.step(-1e-6);
    EXPECT_NEAR(joint.normal_stress(), 0, 1e-9); // back at its origin
    joint.step(-2e-5);
    EXPECT_NEAR(joint.normal_stress(), 2e5, 1e-9);
}

TEST(Mohr, OpensAndClosesWithoutLosingItsPlace) {
    auto joint = joint_of({{"friction", 30}});
    joint.load(1e6);
    const double closed = joint.normal_disp[0];
    for (int cycle = 0; cycle < 50; ++cycle) {
        for (int k = 0; k < 40; ++k) joint.step(3.7e-5);
        EXPECT_EQ(joint.normal_force[0], 0);
        EXPECT_NEAR(joint.history_value("gap"), joint.normal_disp[0] - (closed + 1e6 / kn), 1e-15);
        for (int k = 0; k < 40; ++k) joint.step(-3.7e-5);
        EXPECT_NEAR(joint.normal_stress() / 1e6, 1, 1e-9) << cycle;
    }
}

TEST(Mohr, OpensToZeroForceAtExactlyTheDisplacementOfZeroForce) {
    auto joint = joint_of({{"friction", 30}});
    joint.step(-1e-4);
    joint.step(1.5e-4);
    EXPECT_EQ(joint.normal_force[0], 0);
    EXPECT_NEAR(joint.history_value("gap"), 0.5e-4, 1e-18);
    joint.step(-0.75e-4); // passes the closing point in one step
    EXPECT_NEAR(joint.normal_stress(), kn * 0.25e-4, 1e-6);
}

TEST(Mohr, DilatesByTheTangentOfItsAngleUpToItsEnd) {
    const double psi = 10, end = 2e-3;
    auto joint = joint_of({{"friction", 30}, {"dilation", psi}, {"dilation-zero", end}});
    joint.load(1e6);
    const double start = joint.normal_disp[0];
    for (int k = 0; k < 1000; ++k) {
        joint.slip_at_stress(1e6, {4e-6, 0, 0});
        if (joint.in_state("slip-now")) { EXPECT_NEAR(joint.shear_stress() / (1e6 * tan_degrees(30)), 1, 1e-12); }
        const double slipped = std::min(joint.history_value("slip"), end);
        EXPECT_NEAR(joint.normal_disp[0] - start, slipped * tan_degrees(psi), 1e-12);
    }
    EXPECT_GT(joint.history_value("slip"), end);
}

TEST(Mohr, DilationUnderConfinementEndsOnTheStrengthLine) {
    // No normal motion: the normal spring takes the dilation. One large step agrees with many.
    const Values values{{"friction", 30}, {"cohesion", 0}, {"dilation", 12}};
    auto one = joint_of(values), many = joint_of(values);
    one.load(1e6);
    many.load(1e6);
    one.step(0, {1e-3, 0, 0});
    for (int k = 0; k < 1000; ++k) many.step(0, {1e-6, 0, 0});
    EXPECT_NEAR(one.shear_stress() / (one.normal_stress() * tan_degrees(30)), 1, 1e-12);
    EXPECT_NEAR(one.normal_stress() / many.normal_stress(), 1, 1e-9);
    EXPECT_GT(one.normal_stress(), 1e6);
}

TEST(Mohr, EnergyBalancesOverCyclesOfSlipAndDilation) {
    auto joint = joint_of({{"friction", 30}, {"cohesion", 2e5}, {"dilation", 6}}, 0.7);
    joint.load(1e6);
    const auto stored = [&](const TestJoint& j) {
        return 0.5 / 0.7 * (std::pow(j.normal_force[0], 2) / kn + std::pow(j.shear_force[0][0], 2) / ks);
    };
    double given = 0, scale = 0;
    const double at_start = stored(joint), work_at_start = joint.frictional_work[0];
    for (int k = 0; k < 4000; ++k) {
        const auto before = joint;
        joint.step(1e-7 * std::sin(0.003 * k), {5e-6 * std::cos(0.01 * k), 0, 0});
        given += work_of_step(before, joint);
        scale = std::max(scale, std::abs(given));
        EXPECT_GE(joint.frictional_work[0], before.frictional_work[0] - 1e-9 * scale) << k;
    }
    EXPECT_GT(joint.frictional_work[0], work_at_start);
    EXPECT_NEAR(given, stored(joint) - at_start + joint.frictional_work[0] - work_at_start, 1e-9 * scale);
}

TEST(Mohr, BreakingTakesUpTheEnergyOfTheBond) {
    auto joint = joint_of({{"friction", 30}, {"tension", 2e5}});
    double given = 0;
    for (int k = 0; k < 1000; ++k) {
        const auto before = joint;
        joint.step(1e-7);
        given += work_of_step(before, joint);
    }
    EXPECT_NEAR(joint.frictional_work[0] / (0.5 * 2e5 * 2e5 / kn), 1, 2e-2);
    EXPECT_NEAR(given / joint.frictional_work[0], 1, 2e-2);
}

TEST(Mohr, AnOpenSubContactClosesAtItsGap) {
    auto joint = joint_of({{"friction", 30}, {"cohesion", 1e5}, {"tension", 1e5}});
    joint.normal_disp[0] = 1e-3;
    joint.initialise();
    for (int k = 0; k < 9; ++k) joint.step(-1e-4);
    EXPECT_EQ(joint.normal_force[0], 0);
    joint.step(-2e-4);
    EXPECT_NEAR(joint.normal_stress(), kn * 1e-4, 1e-6);
    joint.step(2e-4); // it was never bonded
    EXPECT_EQ(joint.normal_force[0], 0);
}

TEST(Mohr, AGapOfRoundingIsNone) {
    auto joint = joint_of({{"friction", 30}, {"cohesion", 1e5}, {"tension", 1e5}});
    joint.normal_disp[0] = 1e-16;
    joint.initialise();
    EXPECT_EQ(joint.state[0], 0u);
    EXPECT_EQ(joint.history_value("gap"), 0);
}

TEST(Mohr, AForceFromOutsideClosesTheGap) {
    auto joint = joint_of({{"friction", 30}});
    for (int k = 0; k < 10; ++k) joint.step(1e-5);
    EXPECT_GT(joint.history_value("gap"), 0);
    joint.normal_force[0] = 5e5;
    joint.initialise();
    EXPECT_EQ(joint.history_value("gap"), 0);
    joint.step(0);
    EXPECT_EQ(joint.normal_force[0], 5e5);
}

TEST(Mohr, NinetyDegreesOfFrictionIsNoSlip) {
    auto joint = joint_of({{"friction", 90}});
    joint.load(1e3);
    for (int k = 0; k < 100; ++k) joint.step(0, {1e-3, 0, 0});
    EXPECT_NEAR(joint.shear_stress() / (ks * 0.1), 1, 1e-12);
}

TEST(Mohr, AnAreaOfZeroCarriesNothing) {
    auto joint = joint_of({{"friction", 30}, {"cohesion", 1e5}, {"dilation", 5}}, 0);
    for (int k = 0; k < 10; ++k) joint.step(-1e-4, {1e-3, 0, 0});
    EXPECT_EQ(joint.normal_force[0], 0);
    EXPECT_EQ(joint.shear_force[0][0], 0);
}

TEST(Mohr, RefusesValuesThatCannotWorkTogether) {
    const auto& mohr = shipped("mohr");
    const auto complaint = [&](const Values& values) { return mohr.check(values_of(mohr, values)); };
    EXPECT_THAT(complaint({{"jkn", 1}, {"jks", 0}}), HasSubstr("stiffness-shear (jks) is 0"));
    EXPECT_THAT(complaint({{"jkn", 1}, {"jks", 1}, {"jrten", 1}}), HasSubstr("tension-residual is above tension"));
    EXPECT_THAT(complaint({{"jkn", 1}, {"jks", 1}, {"jrcoh", 1}}), HasSubstr("cohesion-residual is above cohesion"));
    EXPECT_EQ(complaint({{"jkn", 1}, {"jks", 1}, {"jcoh", 2}, {"jrcoh", 1}}), "");
}

} // namespace
} // namespace kaya
