// Extensions of Coulomb's joint model: each compared with the formula of its page.
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
using testing::HasSubstr;

double tan_degrees(double angle) { return std::tan(angle * std::numbers::pi / 180); }
double degrees(double tangent) { return std::atan(tangent) * 180 / std::numbers::pi; }

constexpr double kn = 1e4, ks = 5e3; // MPa/m

TestJoint joint_of(const char* model, Values more) {
    more["jkn"] = kn;
    more["jks"] = ks;
    return TestJoint(shipped(model), more, 0.04);
}

void shear(TestJoint& joint, double way, double by) {
    for (int k = 0; k < std::lround(way / by); ++k) joint.step(0, {by, 0, 0});
}

TEST(BilinearMohr, HasALineBelowAndALineAboveTheCrossing) {
    // The lines intersect at (1 - 0.2)/(tan 40 - tan 20) = 1.684 MPa.
    const Values lines = {{"friction", 40},  {"cohesion", 0.2},          {"friction-2", 20},
                          {"cohesion-2", 1}, {"cohesion-residual", 0.2}, {"c2-residual", 1}};
    for (const double stress : {0.5, 1.5, 1.8, 6.0}) {
        auto joint = joint_of("bilinear-mohr", lines);
        joint.load(stress);
        shear(joint, 4e-3, 1e-6);
        const double low = 0.2 + stress * tan_degrees(40), high = 1 + stress * tan_degrees(20);
        EXPECT_NEAR(joint.shear_stress() / (stress < 1.684 ? low : high), 1, 1e-12) << stress;
        EXPECT_LE(joint.shear_stress(), std::min(low, high) * (1 + 1e-12));
    }
}

TEST(BilinearMohr, TakesAGivenCrossingAndResidualLines) {
    auto joint = joint_of("bilinear-mohr", {{"friction", 40},
                                            {"friction-2", 20},
                                            {"cohesion-2", 1},
                                            {"nstress", 3},
                                            {"friction-residual", 25},
                                            {"f2-residual", 15},
                                            {"nstress-residual", 1}});
    joint.load(2); // below 3: the first line, although the second is lower
    double highest = 0;
    for (int k = 0; k < 2000; ++k) {
        joint.step(0, {1e-6, 0, 0});
        highest = std::max(highest, joint.shear_stress());
    }
    EXPECT_NEAR(highest / (2 * tan_degrees(40)), 1, 1e-12);
    EXPECT_NEAR(joint.shear_stress() / (2 * tan_degrees(15)), 1, 1e-12); // after failure 2 is above 1
}

TEST(BilinearMohr, DilatesWithTheLineThatItIsOn) {
    const Values values = {{"friction", 40}, {"friction-2", 20}, {"cohesion-2", 1},
                           {"dilation", 10}, {"dilation-2", 3},  {"c2-residual", 1}};
    for (const double stress : {0.5, 6.0}) {
        auto joint = joint_of("bilinear-mohr", values);
        joint.load(stress);
        shear(joint, 1e-3, 1e-6);
        const double risen = joint.normal_stress() - stress, slip = joint.history_value("slip");
        if (stress == 6.0) {
            EXPECT_NEAR(risen / (kn * slip * tan_degrees(3)), 1, 1e-9);
        } else {
            EXPECT_GT(risen, kn * slip * tan_degrees(3));
        }
    }
}

TEST(BilinearMohr, RefusesLinesThatDoNotCross) {
    const auto& model = shipped("bilinear-mohr");
    const auto values = values_of(
        model, {{"jkn", 1}, {"jks", 1}, {"friction", 20}, {"cohesion", 0}, {"friction-2", 30}, {"cohesion-2", 1}});
    EXPECT_THAT(model.check(values), HasSubstr("do not cross"));
}

TEST(SofteningMohr, FallsWithSlipOverItsDistance) {
    for (const double alpha : {1.0, 2.0}) {
        auto joint =
            joint_of("softening-mohr",
                     {{"friction", 40}, {"friction-residual", 20}, {"cohesion", 0.5}, {"dc", 1e-3}, {"alpha", alpha}});
        joint.load(2);
        for (const double way : {1e-3, 1e-3, 1e-3}) {
            shear(joint, way, 1e-7);
            const double slip = joint.history_value("slip");
            const double left = slip < 1e-3 ? std::pow(1 - slip / 1e-3, alpha) : 0;
            const double tangent = tan_degrees(20) + (tan_degrees(40) - tan_degrees(20)) * left;
            EXPECT_NEAR(joint.shear_stress() / (0.5 * left + 2 * tangent), 1, 1e-3) << alpha;
            EXPECT_NEAR(joint.history_value("friction-current"), degrees(tangent), 1e-2);
        }
        EXPECT_NEAR(joint.shear_stress() / (2 * tan_degrees(20)), 1, 1e-12); // beyond dc
    }
}

TEST(SofteningMohr, FrictionHealsAtRestAndCohesionDoesNot) {
    const Values values = {
        {"friction", 40}, {"friction-residual", 20}, {"cohesion", 0.5}, {"dc", 1e-3}, {"healing-time", 0.01}};
    auto joint = joint_of("softening-mohr", values);
    joint.load(2);
    shear(joint, 3e-3, 1e-6);
    joint.step(0, {-1e-5, 0, 0});
    joint.time_step = 0.004;
    joint.step(0);
    EXPECT_NEAR(joint.history_value("friction-current"), 20, 1e-9); // not long enough
    joint.step(0);
    joint.step(0);
    EXPECT_NEAR(joint.history_value("friction-current"), 40, 1e-9);
    double highest = 0;
    for (int k = 0; k < 2000; ++k) {
        joint.step(0, {1e-7, 0, 0});
        highest = std::max(highest, joint.shear_stress());
    }
    EXPECT_NEAR(highest / (2 * tan_degrees(40)), 1, 2e-4);

    auto other_values = values;
    other_values["healing"] = 0;
    auto other = joint_of("softening-mohr", other_values);
    other.load(2);
    shear(other, 3e-3, 1e-6);
    other.time_step = 1;
    other.step(0, {-1e-5, 0, 0});
    shear(other, 1e-3, 1e-6);
    EXPECT_NEAR(other.shear_stress() / (2 * tan_degrees(20)), 1, 1e-12);
}

TEST(Power, RelaxesAsThePowerSays) {
    // At a constant displacement: d tau/dt = -ks C tau^n, so tau^(1-n) = tau_0^(1-n) + (n-1) ks C t.
    auto joint = joint_of("power", {{"friction", 80}, {"constant-1", 1e-7}, {"exponent-1", 3}});
    joint.load(5);
    joint.time_step = 0;
    joint.step(0, {4e-4, 0, 0});
    ASSERT_NEAR(joint.shear_stress(), 2, 1e-12);
    joint.time_step = 0.1;
    for (int k = 0; k < 10000; ++k) joint.step(0);
    EXPECT_NEAR(joint.shear_stress(), 1 / std::sqrt(0.25 + 2 * ks * 1e-7 * 1000), 1e-4);
    EXPECT_NEAR(joint.history_value("creep") * ks, 2 - joint.shear_stress(), 1e-9);
    EXPECT_EQ(joint.state[0], 0u); // creep is not a failure
}

TEST(Power, SteadyCreepHasTheSumOfBothSpeeds) {
    // At a constant shear speed the stress becomes constant when the speed of creep equals that of the motion.
    auto joint = joint_of("power", {{"friction", 80},
                                    {"constant-1", 1e-6},
                                    {"exponent-1", 2},
                                    {"constant-2", 1e-6},
                                    {"exponent-2", 4},
                                    {"stress-2", 1}});
    joint.load(5);
    joint.time_step = 0.1;
    for (int k = 0; k < 20000; ++k) joint.step(0, {2e-6, 0, 0}); // 2e-5 per second: s^2 + s^4 = 20
    EXPECT_NEAR(joint.shear_stress(), 2, 1e-9);
    for (int k = 0; k < 200000; ++k)
        joint.step(0, {1.5e-7, 0, 0}); // 1.5e-6: one creep term is too slow at 1, both are too fast
    EXPECT_NEAR(joint.shear_stress(), 1, 1e-9);
}

TEST(Power, ALargeStepIsStableAndAtMostRelaxes) {
    auto joint = joint_of("power", {{"friction", 80}, {"constant-1", 1}, {"exponent-1", 8}});
    joint.load(5);
    joint.time_step = 1e6;
    for (int k = 0; k < 100; ++k) {
        joint.step(0, {1e-4, 0, 0});
        ASSERT_GE(joint.shear_stress(), 0);
        ASSERT_LE(joint.shear_stress(), 5 * tan_degrees(80));
    }
}

TEST(VelocityWeakening, FrictionFollowsTheSpeed) {
    for (const double use_plastic : {0.0, 1.0})
        for (const double speed : {1e-4, 0.05, 0.1, 1.0, 100.0}) {
            auto joint = joint_of("velocity-weakening", {{"friction-static", 35},
                                                         {"friction-dynamic", 10},
                                                         {"reference-velocity", 0.1},
                                                         {"exponent", 2},
                                                         {"use-plastic", use_plastic}});
            joint.load(2);
            joint.time_step = 1e-6 / speed;
            shear(joint, 2e-3, 1e-6);
            const double tangent = tan_degrees(10) + (tan_degrees(35) - tan_degrees(10)) / (1 + speed * speed / 0.01);
            EXPECT_NEAR(joint.shear_stress() / (2 * tangent), 1, 1e-9) << speed << ' ' << use_plastic;
            EXPECT_NEAR(joint.history_value("friction-current"), degrees(tangent), 1e-7);
        }
}

TEST(CoulombFamily, RefusesResidualsAboveThePeak) {
    struct {
        const char* model;
        Values more;
        const char* message;
    } const wrong[] = {
        {"bilinear-mohr",
         {{"friction-2", 10}, {"cohesion-2", 1}, {"c2-residual", 2}, {"friction", 20}},
         "cohesion-2-residual is above"},
        {"softening-mohr", {{"dc", 1}, {"friction", 20}, {"friction-residual", 30}}, "friction-residual is above"},
        {"softening-mohr", {{"dc", 0}}, "dc is 0"},
        {"power", {{"tension-residual", 1}}, "tension-residual is above"},
        {"velocity-weakening", {{"reference-velocity", 1}, {"friction-dynamic", 30}}, "friction-dynamic is above"},
        {"velocity-weakening", {{"reference-velocity", 0}}, "reference-velocity is 0"},
        {"nonlinear", {{"kn-minimum", 2}, {"kn-maximum", 1}}, "kn-minimum is above"},
        {"nonlinear", {{"exponent-normal", 1}}, "exponent-normal is 1"},
        {"nonlinear", {{"exponent-normal", 1}, {"kn-minimum", 0}}, "exponent-normal is 1"},
        {"nonlinear", {{"kn-maximum", 0}}, "kn-maximum or ks-maximum is 0"},
        {"continuously-yielding",
         {{"friction", 30}, {"friction-initial", 40}, {"roughness", 1}, {"jen", 1}},
         "give kn-minimum"},
        {"continuously-yielding", {{"friction", 40}, {"friction-initial", 30}, {"roughness", 1}}, "friction is above"},
        {"continuously-yielding",
         {{"friction", 30}, {"friction-initial", 40}, {"roughness", 0}},
         "roughness (jr) is 0"},
    };
    for (const auto& w : wrong) {
        auto values = w.more;
        values["jkn"] = 1;
        values["jks"] = 1;
        const auto& model = shipped(w.model);
        EXPECT_THAT(model.check(values_of(model, values)), HasSubstr(w.message)) << w.model;
    }
}

} // namespace
} // namespace kaya
