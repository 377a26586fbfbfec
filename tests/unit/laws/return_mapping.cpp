#include "kaya/law/return_mapping.hpp"

#include "test_joint.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace kaya::joints {
namespace {

TEST(BracketedRoot, FindsRootsToTheLastBits) {
    EXPECT_NEAR(bracketed_root([](double x) { return x * x - 2; }, 0, 2).x, std::numbers::sqrt2, 1e-15);
    EXPECT_NEAR(bracketed_root([](double x) { return std::cos(x) - x; }, 0, 1).x, 0.73908513321516067, 1e-15);
    EXPECT_NEAR(bracketed_root([](double x) { return 1e12 * (std::exp(-x) - 1e-6); }, 0, 100).x, 6 * std::numbers::ln10,
                1e-13);
    EXPECT_EQ(bracketed_root([](double x) { return x; }, 0, 1).x, 0);
    EXPECT_EQ(bracketed_root([](double x) { return x - 1; }, 0, 1).x, 1);
}

TEST(BracketedRoot, TakesFewCallsAlsoOfFunctionsThatAreFlatOrSteep) {
    for (const double power : {1.0, 3.0, 9.0, 19.0}) {
        int calls = 0;
        const auto root = bracketed_root(
            [&](double x) {
                ++calls;
                return std::pow(x, power) - 1e-3;
            },
            0, 10);
        EXPECT_TRUE(root.found);
        EXPECT_NEAR(root.x, std::pow(1e-3, 1 / power), 1e-14) << power;
        EXPECT_LT(calls, 80) << power;
    }
}

TEST(BracketedRoot, EndsAtAJump) {
    const auto root = bracketed_root([](double x) { return x < 0.3 ? -1.0 : 1.0; }, 0, 1);
    EXPECT_TRUE(root.found);
    EXPECT_NEAR(root.x, 0.3, 1e-15);
}

TEST(BracketedRoot, SaysThatThereIsNone) {
    EXPECT_FALSE(bracketed_root([](double x) { return x + 1; }, 0, 1).found);
    EXPECT_FALSE(bracketed_root([](double) { return std::nan(""); }, 0, 1).found);
}

TEST(BracketedRoot, KeepsToTheTolerance) {
    int calls = 0;
    const auto root = bracketed_root(
        [&](double x) {
            ++calls;
            return std::atan(x - 0.123);
        },
        -10, 10, 1e-3);
    EXPECT_NEAR(root.x, 0.123, 1e-3);
    EXPECT_LT(calls, 12);
}

TEST(ReturnMapping, CoulombIsTheClosedFormOfTheGeneralOne) {
    const Springs k{3e9, 1e9};
    for (const double friction : {0.0, 20.0, 45.0})
        for (const double dilation : {0.0, 5.0, 15.0})
            for (const double shear : {0.0, 1e5, 3e6, 2e7}) {
                const double f = std::tan(friction * std::numbers::pi / 180),
                             d = std::tan(dilation * std::numbers::pi / 180);
                const auto closed = return_to_coulomb(1e6, shear, k, 2e5, f, d);
                const auto searched =
                    return_to([&](double normal, double) { return 2e5 + normal * f; }, 1e6, shear, k, d);
                EXPECT_NEAR(closed.shear, searched.shear, 1e-9 * (1 + shear));
                EXPECT_NEAR(closed.normal, searched.normal, 1e-9 * (1e6 + shear));
                EXPECT_NEAR(closed.slip, searched.slip, 1e-12 * (1 + closed.slip));
                EXPECT_LE(closed.shear, 2e5 + closed.normal * f + 1e-6);
            }
}

TEST(ReturnMapping, TensionWithoutStrengthTakesAllShear) {
    const auto left = return_to_coulomb(-1e6, 5e5, {1e9, 1e9}, 1e5, 0.5, 0);
    EXPECT_EQ(left.shear, 0);
    EXPECT_DOUBLE_EQ(left.slip, 5e-4);
    EXPECT_DOUBLE_EQ(left.work(2e5), 0.5 * 2e5 * 5e-4); // 2e5 stood before the step
}

/// Friction that falls with slip, tan = r + (p - r) exp(-s/d), sheared under a constant normal stress in a stiff normal spring or a
/// soft one, with dilation and without. What steps take up is what was put in less what the springs hold, to rounding; without
/// dilation it goes to the integral of strength over slip with the square of the step.
TEST(ReturnMapping, WorkIsWhatWasPutInLessWhatIsHeld) {
    const double peak = std::tan(30 * std::numbers::pi / 180), rest = std::tan(20 * std::numbers::pi / 180);
    const double scale = 2e-3, far = 5e-3, normal_at_start = 1e6;
    for (const Springs k : {Springs{2e10, 5e9}, Springs{2e9, 1e9}})
        for (const double dilation : {0.0, 0.1})
            for (const int steps : {100, 1000, 10000}) {
                double normal = normal_at_start, shear = 0, slip = 0, put_in = 0, taken_up = 0;
                const auto held = [&] { return normal * normal / (2 * k.normal) + shear * shear / (2 * k.shear); };
                const double held_at_start = held();
                for (int i = 0; i < steps; ++i) {
                    const double old_normal = normal, old_shear = shear, step = far / steps;
                    const auto left = return_to(
                        [&](double pressure, double more) {
                            return pressure * (rest + (peak - rest) * std::exp(-(slip + more) / scale));
                        },
                        normal, shear + k.shear * step, k, dilation);
                    normal = left.normal, shear = left.shear, slip += left.slip;
                    put_in += 0.5 * (old_shear + shear) * step; // no opening: the normal spring is held at both ends
                    taken_up += left.work(old_shear) - left.lifting(old_normal);
                }
                EXPECT_NEAR(taken_up, put_in - (held() - held_at_start), 1e-13 * put_in);
                if (dilation > 0) continue;
                const double integral =
                    normal_at_start * (rest * slip + (peak - rest) * scale * (1 - std::exp(-slip / scale)));
                // The step in which slip begins is partly elastic: at most ks/8 of its square.
                EXPECT_NEAR(taken_up, integral, 0.15 * k.shear * (far / steps) * (far / steps));
            }
}

/// The shipped model as an independent check: one large step of shear.
TEST(ReturnMapping, GivesTheForceOfMohr) {
    test::TestJoint joint(test::shipped("mohr"), {{"jkn", 3e9}, {"jks", 1e9}, {"jfriction", 30}}, 1, 1);
    joint.step(-1e-3);
    const double normal = joint.normal_force[0];
    joint.step(0, {5e-3, 0, 0});
    const auto left = return_to_coulomb(normal, 1e9 * 5e-3, {3e9, 1e9}, 0, std::tan(std::numbers::pi / 6), 0);
    EXPECT_NEAR(-joint.shear_force[0][0], left.shear, 1e-9 * left.shear);
}

} // namespace
} // namespace kaya::joints
