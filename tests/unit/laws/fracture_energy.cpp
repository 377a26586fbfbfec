// The joint model `fracture-energy` against the formulas of its page.
#include "test_joint.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace kaya {
namespace {

using test::shipped;
using test::TestJoint;
using test::Values;
using test::values_of;
using test::with;
using testing::HasSubstr;

// MPa and m: values of masonry.
constexpr double kn = 8e4, ks = 3.6e4, area = 0.02;
constexpr double ft = 0.25, g1 = 1.8e-5, c = 0.35, g2 = 1.25e-4, whole = 37, broken = 30;
const Values mortar = {{"kn", kn},      {"ks", ks}, {"tension", ft},     {"g1", g1},
                       {"cohesion", c}, {"g2", g2}, {"friction", whole}, {"friction-residual", broken}};

TestJoint joint_of(const Values& more) { return TestJoint(shipped("fracture-energy"), with(mortar, more), area); }
double tan_degrees(double angle) { return std::tan(angle * std::numbers::pi / 180); }
double lost(const TestJoint& joint) { return joint.frictional_work[0] / area; }

/// The softening curve, and the opening of a whole unit of it; straight or exponential.
struct Curve {
    bool straight;
    double left(double x) const { return straight ? std::max(0.0, 1 - x) : std::exp(-x); }
    double unit(double energy, double strength) const { return energy / strength * (straight ? 2 : 1); }
};

class FractureEnergy : public testing::TestWithParam<bool> {
protected:
    Curve curve{GetParam()};
    Values values{{"straight", GetParam()}};
    double elastic = ft / kn;
    double length = curve.unit(g1 / ft - 0.5 * elastic, 1);
    double slip_length = curve.unit(g2, c);
    double strength_at(double normal, double x) const {
        return c * curve.left(x) +
               normal * (tan_degrees(broken) + (tan_degrees(whole) - tan_degrees(broken)) * curve.left(x));
    }
};

TEST_P(FractureEnergy, OpensAlongItsEnvelopeAndDissipatesItsEnergy) {
    auto joint = joint_of(values);
    double put_in = 0;
    for (int k = 1; joint.normal_disp[0] < 45 * length; ++k) {
        const double before = joint.normal_stress();
        const double by = joint.normal_disp[0] < 5 * elastic ? elastic / 50 : length / 100;
        joint.step(by);
        const double u = joint.normal_disp[0], x = (u - elastic) / length;
        ASSERT_NEAR(-joint.normal_stress(), u < elastic ? kn * u : ft * curve.left(x),
                    1e-12 * ft + 1e-9 * ft * (u > elastic))
            << u;
        put_in -= 0.5 * (before + joint.normal_stress()) * by;
    }
    EXPECT_NEAR(lost(joint) / g1, 1, 1e-12);
    EXPECT_NEAR(put_in / g1, 1, 1e-3); // trapezoids
    EXPECT_TRUE(joint.in_state("tension-past") || joint.in_state("tension-now"));
}

TEST_P(FractureEnergy, UnloadsToTheOriginClosesWithItsFullStiffnessAndReloadsToWhereItWas) {
    auto joint = joint_of(values);
    const double far = elastic + 0.7 * length;
    for (int k = 0; k < 100; ++k) joint.step(far / 100);
    const double held = joint.normal_stress(), taken = lost(joint);
    EXPECT_NEAR(-held / (ft * curve.left(0.7)), 1, 1e-12);
    joint.step(-0.5 * far);
    EXPECT_NEAR(joint.normal_stress() / held, 0.5, 1e-12);
    joint.step(-0.5 * far - 1e-5);
    EXPECT_NEAR(joint.normal_stress() / (kn * 1e-5), 1, 1e-9);
    joint.step(1e-5 + far);
    EXPECT_NEAR(joint.normal_stress() / held, 1, 1e-9);
    EXPECT_DOUBLE_EQ(lost(joint), taken);
    joint.step(0.1 * length);
    EXPECT_NEAR(-joint.normal_stress() / (ft * curve.left(0.8)), 1, 1e-9);
}

TEST_P(FractureEnergy, SlipsAlongItsEnvelopeForAnyStepAndDissipatesItsEnergy) {
    for (const double stress : {0.0, 0.5, 2.0})
        for (const int steps : {50, 2000}) {
            auto joint = joint_of(values);
            joint.load(stress);
            double friction = 0, angle_before = tan_degrees(whole);
            const double far = (GetParam() ? 1.5 : 30) * slip_length + 1e-3 / steps;
            for (int k = 0; k < steps; ++k) {
                const double slip_before = joint.history_value("slip");
                joint.step(0, {0.6 * far / steps, -0.8 * far / steps, 0});
                const double slipped = joint.history_value("slip");
                if (slipped > slip_before) {
                    ASSERT_NEAR(joint.shear_stress(), strength_at(stress, slipped / slip_length), 1e-9)
                        << stress << ' ' << slipped;
                }
                const double angle = tan_degrees(broken) +
                                     (tan_degrees(whole) - tan_degrees(broken)) * curve.left(slipped / slip_length);
                friction += stress * 0.5 * (angle + angle_before) * (slipped - slip_before);
                angle_before = angle;
            }
            EXPECT_NEAR(joint.normal_stress(), stress, 1e-12);
            if (steps == 2000) { EXPECT_NEAR((lost(joint) - friction) / g2, 1, 2e-3) << stress; }
        }
}

TEST_P(FractureEnergy, IsWeakerInTensionAfterSlipAndInShearAfterOpening) {
    auto slipped = joint_of(values);
    slipped.load(0.2);
    for (int k = 0; k < 400; ++k) slipped.step(0, {slip_length / 400, 0, 0});
    const double x = slipped.history_value("softening");
    EXPECT_NEAR(x, slipped.history_value("slip") / slip_length, 1e-12);
    ASSERT_GT(x, 0.5);
    slipped.step(0, {-slipped.shear_stress() / ks, 0, 0});
    slipped.step(0.2 / kn + elastic + x * length);
    EXPECT_NEAR(-slipped.normal_stress() / (ft * curve.left(x)), 1, 1e-9);

    auto opened = joint_of(values);
    opened.step(elastic + 0.6 * length);
    opened.step(-elastic - 0.6 * length - 0.5 / kn);
    opened.step(0, {4e-5, 0, 0});
    EXPECT_NEAR(opened.shear_stress(), strength_at(0.5, opened.history_value("softening")), 1e-9);
    EXPECT_GE(opened.history_value("softening"), 0.6);
}

INSTANTIATE_TEST_SUITE_P(Curves, FractureEnergy, testing::Bool(),
                         [](const auto& name) { return name.param ? "Straight" : "Exponential"; });

TEST(FractureEnergyCap, CrushesAlongItsEnvelopeAndUnloadsWithTheSpring) {
    constexpr double fc = 10, rest = 2, g3 = 5e-3;
    auto joint = joint_of({{"compression", fc}, {"compression-residual", rest}, {"g3", g3}});
    for (int k = 0; k < 4000; ++k) {
        joint.step(-2e-6);
        const double crushed = joint.history_value("crushed");
        if (crushed > 0) {
            ASSERT_NEAR(joint.normal_stress(), rest + (fc - rest) * std::exp(-crushed * (fc - rest) / g3), 1e-9);
        }
    }
    const double crushed = joint.history_value("crushed");
    EXPECT_NEAR((lost(joint) - rest * crushed) / (g3 * (1 - std::exp(-crushed * (fc - rest) / g3))), 1, 1e-9);
    const double stress = joint.normal_stress(), taken = lost(joint);
    joint.step(0.5 * stress / kn);
    EXPECT_NEAR(joint.normal_stress() / stress, 0.5, 1e-9);
    EXPECT_DOUBLE_EQ(lost(joint), taken);
    // Without a residual strength it crushes at a constant stress.
    auto plain = joint_of({{"compression", fc}});
    for (int k = 0; k < 300; ++k) plain.step(-2e-6);
    EXPECT_NEAR(plain.normal_stress(), fc, 1e-12);
    EXPECT_NEAR(lost(plain), fc * (6e-4 - fc / kn), 1e-12);
}

TEST(FractureEnergyCap, ShearCountsInCrushing) {
    auto joint = joint_of({{"compression", 10}, {"cap-shear", 9}});
    joint.load(9.5);
    for (int k = 0; k < 100; ++k) joint.step(0, {1e-5, 0, 0});
    EXPECT_NEAR(joint.shear_stress(), std::sqrt((100 - 9.5 * 9.5) / 9), 1e-9);
}

TEST(FractureEnergyBalance, WhatIsPutInIsStoredOrLostOnAnyPath) {
    for (const bool straight : {false, true})
        for (unsigned seed = 1; seed <= 6; ++seed) {
            std::mt19937 random(seed);
            std::uniform_real_distribution<double> any(-1, 1);
            auto joint = joint_of({{"straight", straight},
                                   {"compression", 3},
                                   {"compression-residual", 1},
                                   {"g3", 1e-3},
                                   {"cap-shear", 4}});
            double put_in = 0, moved = 0, before = 0;
            for (int k = 0; k < 40000; ++k) {
                static double a, b, d;
                if (k % 1000 == 0) a = any(random) * 5e-8, b = any(random) * 5e-8, d = any(random) * 5e-8;
                const auto old = joint;
                joint.step(a, {b, d, 0});
                const double work = test::work_of_step(old, joint) / area;
                put_in += work;
                moved += std::abs(work);
                ASSERT_GE(lost(joint), before - 1e-15) << k; // nothing comes back
                before = lost(joint);
                const double normal = joint.normal_stress(), shear = joint.shear_stress();
                const double stored =
                    0.5 * (normal > 0 ? normal * normal / kn : -normal * joint.history_value("opening")) +
                    0.5 * shear * shear / ks;
                ASSERT_NEAR(put_in, stored + lost(joint), 2e-3 * moved + 1e-9) << straight << ' ' << seed << ' ' << k;
            }
        }
}

TEST(FractureEnergyValues, AreRefusedWithWhatToDo) {
    struct Row {
        Values values;
        const char* says;
    };
    const Row rows[] = {
        {{{"g1", NAN}}, "tension is given without energy-tension"},
        {{{"g1", 1e-9}}, "energy-tension is not above"},
        {{{"g2", NAN}}, "cohesion is given without energy-shear"},
        {{{"g2", 1e-7}}, "energy-shear is so small"},
        {{{"friction-residual", 50}}, "friction-residual is above friction"},
        {{{"cohesion", 0}}, "friction-residual is below friction"},
        {{{"compression-residual", 1}}, "need compression"},
        {{{"cap-shear", 9}}, "need compression"},
        {{{"compression", 0}}, "compression is 0"},
        {{{"compression", 1}, {"compression-residual", 2}}, "compression-residual is above compression"},
        {{{"compression", 2}, {"compression-residual", 1}}, "without energy-compression"},
        {{{"compression", 20}, {"compression-residual", 1}, {"g3", 1e-6}}, "energy-compression is so small"},
    };
    const auto& model = shipped("fracture-energy");
    EXPECT_EQ(model.check(values_of(model, mortar)), "");
    for (const auto& row : rows)
        EXPECT_THAT(model.check(values_of(model, with(mortar, row.values))), HasSubstr(row.says));
}

TEST(FractureEnergyStart, OpenSidesHaveNoBondAndATensionFromOutsideHasItsOpening) {
    auto open = joint_of({});
    open.normal_disp[0] = 1e-4;
    open.initialise();
    open.step(-1.1e-4);
    EXPECT_NEAR(open.normal_stress() / (kn * 1e-5), 1, 1e-9);
    open.step(1.5e-5);
    EXPECT_EQ(open.normal_stress(), 0);

    auto pulled = joint_of({});
    pulled.normal_force[0] = -0.1 * area;
    pulled.initialise();
    pulled.step(0.05 / kn);
    EXPECT_NEAR(pulled.normal_stress(), -0.15, 1e-12);
}

} // namespace
} // namespace kaya
