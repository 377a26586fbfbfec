// Joint models with stress-dependent stiffness: nonlinear and continuously-yielding.
#include "test_joint.hpp"
#include "laws/stiffness_trial.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace kaya {
namespace {

using test::shipped;
using test::TestJoint;
using test::Values;

double tan_degrees(double angle) { return std::tan(angle * std::numbers::pi / 180); }

TestJoint yielding(Values more = {}) {
    Values values = {
        {"kn-initial", 2e4}, {"ks-initial", 1e4}, {"friction", 30}, {"friction-initial", 50}, {"roughness", 3e-3}};
    for (const auto& [word, value] : more) values[word] = value;
    return TestJoint(shipped("continuously-yielding"), values, 0.04);
}

TEST(ContinuouslyYielding, FollowsTheReferenceIntegration) {
    // Normal stress 2 MPa, ks 10 GPa/m, phi_m from 50 to 30 degrees with R = 3 mm; a reference integration of
    // (2), (3), (5), (6) of the page.
    const std::map<int, double> stresses = {
        {1000, 2.08115}, {2000, 1.77629}, {5000, 1.35621}, {10000, 1.19097}, {20000, 1.15598}};
    auto joint = yielding();
    joint.load(2);
    double peak = 0, at = 0;
    for (int k = 1; k <= 20000; ++k) {
        joint.step(0, {1e-6, 0, 0});
        if (joint.shear_stress() > peak) peak = joint.shear_stress(), at = 1e-6 * k;
        if (stresses.contains(k)) { EXPECT_NEAR(joint.shear_stress(), stresses.at(k), 2e-5 * stresses.at(k)) << k; }
        if (k == 5000) { EXPECT_NEAR(joint.history_value("friction-current"), 33.952, 1e-3); }
    }
    EXPECT_NEAR(peak, 2.12223, 1e-5);
    EXPECT_NEAR(at, 0.7535e-3, 2e-6);
    EXPECT_NEAR(joint.normal_stress(), 2, 1e-12);
}

TEST(ContinuouslyYielding, LargeStepsGiveNearlyTheSame) {
    auto fine = yielding(), coarse = yielding();
    fine.load(2);
    coarse.load(2);
    for (int k = 0; k < 5000; ++k) fine.step(0, {1e-6, 0, 0});
    for (int k = 0; k < 50; ++k) coarse.step(0, {1e-4, 0, 0});
    EXPECT_NEAR(coarse.shear_stress() / fine.shear_stress(), 1, 2e-3);
}

TEST(ContinuouslyYielding, ReversesWithItsFullStiffness) {
    auto joint = yielding();
    joint.load(2);
    for (int k = 0; k < 600; ++k) joint.step(0, {1e-6, 0, 0});
    const double before = joint.shear_stress();
    joint.step(0, {-1e-8, 0, 0});
    EXPECT_NEAR((before - joint.shear_stress()) / 1e-8, 1e4, 1e2);
    EXPECT_LT(joint.history_value("reversal-ratio"), 0);
    for (int k = 0; k < 300; ++k) joint.step(0, {-1e-6, 0, 0});
    const double low = joint.shear_stress();
    joint.step(0, {1e-8, 0, 0}); // and again when it reverses again
    EXPECT_NEAR(std::abs(low - joint.shear_stress()) / 1e-8, 1e4, 1e2);
}

TEST(ContinuouslyYielding, IsTheSameInEveryDirection) {
    auto along = yielding(), turned = yielding();
    along.load(2);
    turned.load(2);
    const double c = std::cos(0.7), s = std::sin(0.7);
    for (int k = 0; k < 3000; ++k) {
        const double way = k < 1000 || k > 1800 ? 1e-6 : -1e-6;
        along.step(0, {way, 0, 0});
        turned.step(0, {way * c, way * s, 0});
    }
    EXPECT_NEAR(turned.shear_stress(), along.shear_stress(), 1e-9);
    // Sheared further in another direction, the resistance ends up in that direction.
    for (int k = 0; k < 30000; ++k) along.step(0, {0, 1e-6, 0});
    EXPECT_NEAR(along.shear_force[0][0], 0, 1e-9);
    EXPECT_NEAR(along.shear_stress() / (2 * tan_degrees(30)), 1, 2e-3);
}

TEST(ContinuouslyYielding, StiffnessesAreItsPowersOfTheNormalStress) {
    auto joint = yielding({{"exponent-normal", 0.4}, {"exponent-shear", 0.7}});
    for (const double stress : {0.1, 1.0, 4.0}) {
        joint.load(stress);
        EXPECT_NEAR(joint.normal_stiffness[0] / (2e4 * std::pow(stress, 0.4)), 1, 1e-9);
        EXPECT_NEAR(joint.shear_stiffness[0] / (1e4 * std::pow(stress, 0.7)), 1, 1e-9);
        auto more = joint;
        more.step(-1e-9);
        EXPECT_NEAR((more.normal_stress() - stress) / 1e-9 / joint.normal_stiffness[0], 1, 1e-4);
    }
}

TEST(ContinuouslyYielding, DilatesByTheAngleAboveItsIntrinsicFriction) {
    auto joint = yielding({{"dilation", 1}});
    joint.load(2);
    double lifted = 0;
    for (int k = 0; k < 5000; ++k) {
        const double worn = joint.history_value("plastic-strain"), closed = joint.normal_disp[0];
        joint.slip_at_stress(2, {1e-6, 0, 0});
        const double angle = std::atan(joint.shear_stress() / 2) * 180 / std::numbers::pi - 30;
        lifted += tan_degrees(std::max(0.0, angle)) * (joint.history_value("plastic-strain") - worn);
        ASSERT_GE(joint.normal_disp[0], closed - 1e-12);
    }
    EXPECT_NEAR(joint.normal_disp[0] - (-2 / 2e4), lifted, 1e-3 * lifted);
    EXPECT_GT(lifted, 1e-4);
}

TEST(Nonlinear, ClosesOnItsCurve) {
    // sigma^(1-e) = (1-e) k_1 c for a power alone; here it starts at sigma_1 = (k_min/k_1)^(1/e) and ends at k_max.
    const Values values = {
        {"jkn", 1e4}, {"jks", 5e3}, {"exponent-normal", 0.5}, {"kn-minimum", 1e3}, {"kn-maximum", 2e4}};
    auto joint = TestJoint(shipped("nonlinear"), values);
    const double stress_1 = 0.01, closure_1 = stress_1 / 1e3, stress_2 = 4;
    const double closure_2 = closure_1 + 2 * (std::sqrt(stress_2) - std::sqrt(stress_1)) / 1e4;
    for (const double closure : {0.5e-5, 1e-4, 3e-4, 8e-4}) {
        const double expected = closure < closure_1   ? 1e3 * closure
                                : closure < closure_2 ? std::pow(std::sqrt(stress_1) + 0.5e4 * (closure - closure_1), 2)
                                                      : stress_2 + 2e4 * (closure - closure_2);
        joint.step(-closure - joint.normal_disp[0]);
        EXPECT_NEAR(joint.normal_stress() / expected, 1, 1e-12) << closure;
        EXPECT_NEAR(joint.normal_stiffness[0] / std::clamp(1e4 * std::sqrt(expected), 1e3, 2e4), 1, 1e-9);
    }
    auto loaded = TestJoint(shipped("nonlinear"), values);
    loaded.normal_force[0] = 3;
    loaded.initialise();
    loaded.step(0);
    EXPECT_NEAR(loaded.normal_stress(), 3, 1e-12);
}

TEST(Nonlinear, IsMohrWhereItsExponentsAreZero) {
    const Values values = {{"jkn", 1e4},      {"jks", 5e3},    {"friction", 35},
                           {"cohesion", 0.3}, {"dilation", 7}, {"dilation-zero", 4e-4}};
    auto mohr = TestJoint(shipped("mohr"), values), same = TestJoint(shipped("nonlinear"), values);
    for (int k = 0; k < 3000; ++k) {
        const double opening = 1e-6 * std::sin(0.01 * k) - 2e-7;
        const test::Vector slip = {2e-6 * std::cos(0.007 * k), 1e-6 * std::sin(0.011 * k), 0};
        mohr.step(opening, slip);
        same.step(opening, slip);
        ASSERT_NEAR(same.normal_stress(), mohr.normal_stress(), 1e-9) << k;
        ASSERT_NEAR(same.shear_stress(), mohr.shear_stress(), 1e-9) << k;
    }
    EXPECT_NEAR(same.history_value("slip") / mohr.history_value("slip"), 1, 1e-9);
}

TEST(Nonlinear, FallingNormalStressTakesShearStressWithIt) {
    auto joint = TestJoint(shipped("nonlinear"), {{"jkn", 1e4}, {"jks", 5e3}, {"exponent-shear", 1}, {"friction", 60}});
    joint.load(4);
    joint.step(0, {1e-5, 0, 0});
    EXPECT_NEAR(joint.shear_stress(), 4 * 5e3 * 1e-5, 1e-12);
    joint.load(2);
    EXPECT_NEAR(joint.shear_stress(), 2 * 5e3 * 1e-5, 1e-9);
    joint.load(4); // and an increasing one does not restore it
    EXPECT_NEAR(joint.shear_stress(), 2 * 5e3 * 1e-5, 1e-9);
}

TEST(Nonlinear, StrengthHoldsExactlyWhileItDilates) {
    auto joint = TestJoint(shipped("nonlinear"), {{"jkn", 1e4},
                                                  {"jks", 5e3},
                                                  {"exponent-normal", 0.6},
                                                  {"exponent-shear", 0.4},
                                                  {"friction", 35},
                                                  {"dilation", 10}});
    joint.load(1);
    for (int k = 0; k < 1000; ++k) joint.step(0, {3e-6, 0, 0});
    EXPECT_GT(joint.normal_stress(), 2);
    EXPECT_NEAR(joint.shear_stress() / (joint.normal_stress() * tan_degrees(35)), 1, 1e-12);
}

// --- the same joint in other units ---------------------------------------------------------------------------------------

/// 1 Pa and 1 m in the units of a deck.
struct Units {
    double stress, length;
};
constexpr Units units[] = {{1, 1}, {1e-3, 1}, {1e-6, 1}, {1e-6, 1e3}, {1, 1e3}, {1 / 6894.757, 1 / 0.3048}};

/// A power joint with values given in Pa and m: k = k_1 sigma^e.
TestJoint power_joint(const char* model, double exponent, const Units& u) {
    const auto of_stiffness = [&](double k_1) { return k_1 * std::pow(u.stress, 1 - exponent) / u.length; };
    Values values = {{"jkn", of_stiffness(1e7)}, {"jks", of_stiffness(5e6)}, {"jen", exponent}, {"jes", exponent}};
    if (std::string(model) == "nonlinear") {
        const Values more = {
            {"friction", 35}, {"cohesion", 2e4 * u.stress}, {"tension", 5e3 * u.stress}, {"dilation", 6}};
        values.insert(more.begin(), more.end());
    } else {
        const Values more = {
            {"friction", 30}, {"friction-initial", 45}, {"roughness", 1e-3 * u.length}, {"dilation", 1}};
        values.insert(more.begin(), more.end());
    }
    return TestJoint(shipped(model), values, 0.25 * u.length * u.length);
}

class PowerJoint : public testing::TestWithParam<const char*> {};

TEST_P(PowerJoint, ClosesAsThePowerAloneInEveryUnit) {
    // sigma^(1-e) = (1-e) k_1 c; with e = 1/2: c = 2 sqrt(sigma)/k_1.
    for (const Units& u : units)
        for (const double e : {0.2, 0.5, 0.8})
            for (const double stress : {1e-3, 24525.0, 1e6, 3e8}) {
                auto joint = power_joint(GetParam(), e, u);
                const double closure = std::pow(stress, 1 - e) / ((1 - e) * 1e7);
                joint.step(-closure * u.length);
                EXPECT_NEAR(joint.normal_stress() / (stress * u.stress), 1, 1e-11)
                    << u.stress << ' ' << e << ' ' << stress;
            }
}

TEST_P(PowerJoint, ReportsItsTangentAndNeverNothing) {
    for (const Units& u : units) {
        auto joint = power_joint(GetParam(), 0.5, u);
        const double per = u.stress / u.length;
        // Without load: the tangent at a closure of 1e-6 of the size, k_1^2 c/2.
        const double unloaded = 0.5e14 * 1e-6 * 0.5;
        EXPECT_NEAR(joint.normal_stiffness[0] / (unloaded * per), 1, 1e-9);
        EXPECT_NEAR(initial_stiffness(*joint.model, joint.values).normal / joint.normal_stiffness[0],
                    1 / std::sqrt(joint.area[0]), 1e-9);
        for (const double stress : {1e4, 1e6, 1e8}) {
            joint.load(stress * u.stress);
            EXPECT_NEAR(joint.normal_stiffness[0] / (1e7 * std::sqrt(stress) * per), 1, 1e-9);
        }
        joint.step(1e-2 * u.length);
        EXPECT_EQ(joint.normal_force[0], 0);
        EXPECT_NEAR(joint.normal_stiffness[0] / (unloaded * per), 1, 1e-9);
    }
}

TEST_P(PowerJoint, FollowsTheSameCurveInEveryUnit) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        std::vector<TestJoint> joints;
        for (const Units& u : units) joints.push_back(power_joint(GetParam(), 0.5, u));
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> any(-1, 1);
        double a = 0, b = 0, c = 0;
        for (int k = 0; k < 3000; ++k) {
            if (k % 50 == 0) a = any(random) - 0.2, b = any(random), c = any(random);
            for (std::size_t i = 0; i < joints.size(); ++i)
                joints[i].step(1e-6 * a * units[i].length, {1e-6 * b * units[i].length, 1e-6 * c * units[i].length, 0});
            for (std::size_t i = 1; i < joints.size(); ++i) {
                const double scale = 1e5 + joints[0].normal_stress();
                ASSERT_NEAR(joints[i].normal_stress() / units[i].stress, joints[0].normal_stress(), 1e-8 * scale) << k;
                ASSERT_NEAR(joints[i].shear_stress() / units[i].stress, joints[0].shear_stress(), 1e-8 * scale) << k;
            }
        }
    }
}

TEST_P(PowerJoint, AMassPutOnItComesToRestWhereItsClosureSays) {
    // From the unloaded joint, in explicit steps of a quarter of the step that the reported tangent allows, increasing at most fourfold;
    // damped by hand.
    for (const Units& u : units) {
        auto joint = power_joint(GetParam(), 0.5, u);
        const double load = 24525 * u.stress * joint.area[0], mass = 2500 * u.stress * u.length; // g = 9.81 m/s2, in s
        double velocity = 0, highest = 0;
        int halved = 0;
        for (int k = 0; k < 4000; ++k) {
            double step = 0.5 * std::sqrt(mass / (joint.normal_stiffness[0] * joint.area[0]));
            const double force = load - joint.normal_force[0];
            TestJoint next = joint;
            for (;; step /= 2, ++halved) {
                next = joint;
                next.step(-(velocity + step * force / mass) * step);
                if (next.normal_stiffness[0] <= 4 * joint.normal_stiffness[0]) break;
            }
            velocity += step * force / mass;
            velocity *= force * velocity > 0 ? 0.99 : 0.9;
            joint.step(-velocity * step);
            highest = std::max(highest, joint.normal_stress());
        }
        EXPECT_LT(halved, 20);
        EXPECT_LT(highest, 3.1 * 24525 * u.stress); // 3 without damping
        EXPECT_NEAR(-joint.normal_disp[0] / (2 * std::sqrt(24525.0) / 1e7 * u.length), 1, 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, PowerJoint, testing::Values("nonlinear", "continuously-yielding"),
                         [](const auto& model) { return std::string(model.param, 0, 9); });

TEST(Nonlinear, ABondPullsOnTheSameCurveAndItsEnergyIsBooked) {
    for (const Units& u : units) {
        auto joint = power_joint("nonlinear", 0.5, u);
        const double strength = 5e3 * u.stress, at = 2 * std::sqrt(5e3) / 1e7 * u.length;
        double put_in = 0, lowest = 0;
        for (int k = 0; k < 5001; ++k) {
            const TestJoint before = joint;
            joint.step(at / 5000);
            put_in += test::work_of_step(before, joint);
            lowest = std::min(lowest, joint.normal_stress());
        }
        EXPECT_NEAR(lowest / strength, -1, 2e-3);
        EXPECT_EQ(joint.normal_force[0], 0);
        EXPECT_NEAR(joint.frictional_work[0] / put_in, 1, 2e-3);
        EXPECT_NEAR(joint.frictional_work[0] / joint.area[0] / (strength * at / 3), 1, 2e-3); // of sigma = (k_1 c/2)^2
    }
}

TEST(Nonlinear, ABondWithoutNormalStressResistsShear) {
    // As stiff as at a normal stress equal to its cohesion.
    for (const Units& u : units) {
        auto joint = power_joint("nonlinear", 0.5, u);
        joint.step(0, {1e-5 * u.length, 0, 0});
        EXPECT_NEAR(joint.shear_stress() / (5e6 * std::sqrt(2e4) * 1e-5 * u.stress), 1, 1e-9);
        joint.step(0, {1e-3 * u.length, 0, 0});
        EXPECT_GE(joint.shear_stress(), 2e4 * u.stress * (1 - 1e-12));
    }
}

} // namespace
} // namespace kaya
