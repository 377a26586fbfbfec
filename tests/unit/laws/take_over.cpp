// A joint model takes over a joint with forces of another model or of a script: every pair.
#include "test_joint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <random>

namespace kaya {
namespace {

using test::shipped;
using test::TestJoint;
using test::Values;

double tan_degrees(double angle) { return std::tan(angle * std::numbers::pi / 180); }

constexpr double never = 1e300, cohesion = 0.3, tension = 0.1;

double coulomb(double normal) { return std::max(0.0, cohesion + normal * tan_degrees(35)); }
/// Below the intersection of both lines at (1 - 0.3)/(tan 35 - tan 20) = 2.08 MPa the first, above it the second.
double bilinear(double normal) { return std::max(0.0, std::min(coulomb(normal), 1 + normal * tan_degrees(20))); }
double bounding(double normal) { return normal * tan_degrees(50); }
/// Barton's, unscaled, at the peak; at most 70 degrees.
double barton(double normal) {
    if (!(normal > 0)) return 0;
    return normal * tan_degrees(20 + std::clamp(8 * std::log10(100 / normal), 0.0, 50.0));
}

/// A joint model and its strength. MPa, m, s.
struct Law {
    const char* name;
    Values values;
    double (*strength)(double normal); ///< null: all
    double tensile;                    ///< strength
    bool dilates = false;
    friend std::ostream& operator<<(std::ostream& out, const Law& law) { return out << law.name; }
};

// A row per law.
// clang-format off
const Law laws[] = {
    {"elastic", {{"jkn", 1e4}, {"jks", 5e3}}, nullptr, never},
    {"mohr", {{"jkn", 1e4}, {"jks", 5e3}, {"friction", 35}, {"cohesion", cohesion}, {"tension", tension}, {"dilation", 6}}, coulomb, tension, true},
    {"bilinear-mohr",
     {{"jkn", 1e4}, {"jks", 5e3}, {"friction", 35}, {"cohesion", cohesion}, {"tension", tension}, {"friction-2", 20}, {"cohesion-2", 1}},
     bilinear,
     tension},
    {"softening-mohr",
     {{"jkn", 1e4}, {"jks", 5e3}, {"friction", 35}, {"friction-residual", 25}, {"cohesion", cohesion}, {"tension", tension}, {"dc", 1e-3}},
     coulomb,
     tension},
    // Brittle in tension and tough in slip, so that its strength is the same before and after.
    {"fracture-energy",
     {{"jkn", 1e4}, {"jks", 5e3}, {"friction", 35}, {"cohesion", cohesion}, {"tension", tension}, {"g1", 5.1e-7}, {"g2", 1e6}},
     coulomb,
     tension},
    {"nonlinear",
     {{"jkn", 1e4}, {"jks", 5e3}, {"jen", 0.5}, {"jes", 0.5}, {"friction", 35}, {"cohesion", cohesion}, {"tension", tension}, {"dilation", 6}},
     coulomb,
     tension,
     true},
    {"power",
     {{"jkn", 1e4}, {"jks", 5e3}, {"friction", 35}, {"cohesion", cohesion}, {"tension", tension}, {"constant-1", 1e-12}, {"exponent-1", 3}},
     coulomb,
     tension},
    {"velocity-weakening",
     {{"jkn", 1e4}, {"jks", 5e3}, {"friction-static", 35}, {"friction-dynamic", 15}, {"reference-velocity", 0.1}, {"cohesion", cohesion},
      {"tension", tension}},
     coulomb,
     tension},
    {"continuously-yielding",
     {{"jkn", 1e4}, {"jks", 5e3}, {"jen", 0.5}, {"jes", 0.5}, {"friction", 30}, {"friction-initial", 50}, {"roughness", 3e-3}, {"dilation", 1}},
     bounding,
     0},
    {"barton-bandis",
     {{"jkn", 1e5}, {"jks", 1e4}, {"friction-residual", 20}, {"jrco", 8}, {"jcso", 100}, {"sigmac", 150}, {"large", 1}},
     barton,
     0},
    {"fresh", {{"jkn", 1e4}, {"jks", 5e3}, {"friction", 35}}, [](double normal) { return std::max(0.0, normal * tan_degrees(35)); }, 0},
};
// clang-format on

/// `fresh` is the template of `kaya new-jmodel fresh`, unchanged.
const JointModel& model_of(const Law& law) {
    return std::string_view(law.name) == "fresh" ? test::compat(law.name) : shipped(law.name);
}

/// Stresses at the change of the model, and the opening.
struct State {
    const char* name;
    double normal, shear_x, shear_y, opening;
};
const State states[] = {
    {"pressed", 2, 0, 0, -2e-4},
    {"sheared", 2, 0.5, -0.3, -2e-4},
    {"sheared beyond all strengths", 2, -6, 3, -2e-4},
    {"hardly pressed", 1e-9, 0, 0, 0},
    {"nothing", 0, 0, 0, 0},
    {"held by a bond", 0, 0.1, 0.1, 0},
    {"torn along", 0, 0.7, 0.2, 0},
    {"pulled by a bond", -0.05, 0.02, 0.01, 5e-6},
    {"torn apart", -0.7, 0.1, -0.2, 7e-5},
    {"apart", 0, 0, 0, 1e-4},
    {"apart, and a force from a script", 0, 0.2, 0, 1e-4},
    {"overlap without force", 0, 0, 0, -1e-4},
};

/// Stresses that the law keeps of a state: normal and shear. The reduction of shear stress is slip, and lifts a dilating joint: `now` is
/// then its normal stress.
std::pair<double, double> carried(const Law& law, const State& s, double now) {
    const double shear = std::hypot(s.shear_x, s.shear_y);
    if (law.strength == nullptr) return {s.normal, shear};
    if (s.normal < -law.tensile || (s.normal == 0 && s.opening > 0)) return {std::max(0.0, s.normal), 0};
    const double strength = law.strength(s.normal);
    if (shear <= strength * (1 + 1e-12)) return {s.normal, shear};
    if (!law.dilates) return {s.normal, strength};
    EXPECT_GE(now, s.normal);
    return {now, law.strength(now)};
}

TestJoint with_forces(const Law& law, const State& s, double area) {
    TestJoint joint(model_of(law), law.values, area);
    joint.normal_force[0] = s.normal * area;
    joint.shear_force[0][0] = s.shear_x * area;
    joint.shear_force[1][0] = s.shear_y * area;
    joint.normal_disp[0] = s.opening;
    joint.initialise();
    return joint;
}

/// The call of the engine after setting forces.
void settle(TestJoint& joint) {
    const double step = joint.time_step;
    joint.time_step = 1e-12;
    joint.step(0);
    joint.time_step = step;
}

double stored(const TestJoint& j) {
    const double n = j.normal_force[0], s = j.shear_stress() * j.area[0];
    const auto of = [&](double force, double stiffness) {
        return stiffness > 0 ? 0.5 * force * force / (stiffness * j.area[0]) : 0;
    };
    return of(n, j.normal_stiffness[0]) + of(s, j.shear_stiffness[0]);
}

/// Forces in direction and size, and all other values finite.
void expect_forces(const TestJoint& j, const State& s, std::pair<double, double> expected, double tolerance) {
    const double shear = std::hypot(s.shear_x, s.shear_y), scale = std::max({1e-12, std::abs(s.normal), shear});
    EXPECT_NEAR(j.normal_stress(), expected.first, tolerance * scale);
    EXPECT_NEAR(j.shear_stress(), expected.second, tolerance * scale);
    if (shear > 0) {
        EXPECT_NEAR(j.shear_force[0][0] / j.area[0], s.shear_x * expected.second / shear, tolerance * scale);
        EXPECT_NEAR(j.shear_force[1][0] / j.area[0], s.shear_y * expected.second / shear, tolerance * scale);
    }
    EXPECT_TRUE(std::isfinite(j.frictional_work[0]));
}

class TakesOver : public testing::TestWithParam<Law> {};

TEST_P(TakesOver, ForcesWithinItsStrengthStayAndOthersAreReducedToIt) {
    for (const State& s : states)
        for (const double area : {0.04, 1.0, 2500.0}) {
            SCOPED_TRACE(testing::Message() << s.name << ", area " << area);
            TestJoint joint = with_forces(GetParam(), s, area);
            const double before = stored(joint);
            settle(joint);
            const auto expected = carried(GetParam(), s, joint.normal_stress());
            expect_forces(joint, s, expected, 1e-9);
            // The lost energy was dissipated, at most the stored energy; the curve of a power of 1/2 stores 4/3 of the energy by its
            // tangent.
            EXPECT_GE(joint.frictional_work[0], -1e-9 * before);
            EXPECT_LE(joint.frictional_work[0], before * 4 / 3 * (1 + 1e-9) + 1e-12);
            for (int k = 0; k < 100; ++k) joint.step(0);
            if (expected.second < std::hypot(s.shear_x, s.shear_y) * (1 - 1e-9)) {
                EXPECT_LE(joint.shear_stress(),
                          expected.second * (1 + 1e-9)); // it has failed: the residual strength applies
            } else {
                expect_forces(joint, s, expected, 1e-9);
            }
        }
}

/// A joint that a law has brought into some state by motion.
TestJoint driven(const Law& law, double normal, double slip, unsigned seed) {
    TestJoint joint(model_of(law), law.values, 0.04);
    if (normal > 0) joint.load(normal);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    const double a = angle(random);
    for (int k = 0; k < 200; ++k) joint.step(0, {slip / 200 * std::cos(a), slip / 200 * std::sin(a), 0});
    if (normal < 0)
        for (int k = 0; k < 100; ++k) joint.step(-normal / 1e4 / 100);
    return joint;
}

TEST_P(TakesOver, FromEveryOtherModelAtAnyForce) {
    unsigned seed = 0;
    for (const Law& from : laws)
        for (const double normal : {3.0, 0.4, 0.0, -0.05})
            for (const double slip : {0.0, 1e-5, 2e-3}) {
                SCOPED_TRACE(testing::Message() << "from " << from << ", normal " << normal << ", slip " << slip);
                const TestJoint left = driven(from, normal, slip, ++seed);
                const State s{"", left.normal_stress(), left.shear_force[0][0] / 0.04, left.shear_force[1][0] / 0.04,
                              left.normal_disp[0]};
                TestJoint joint = with_forces(GetParam(), s, 0.04);
                settle(joint);
                const auto expected = carried(GetParam(), s, joint.normal_stress());
                expect_forces(joint, s, expected, 1e-9);
                const bool all =
                    expected.second >= std::hypot(s.shear_x, s.shear_y) * (1 - 1e-9) && expected.first == s.normal;
                for (int k = 0; k < 100; ++k) joint.step(0);
                if (all) expect_forces(joint, s, expected, 1e-9);
                // The joint continues: compressed, sheared, opened and closed.
                for (const test::Vector& way : {test::Vector{1e-6, 0, 0}, {-2e-6, 1e-6, 0}, {0, 0, 0}})
                    for (const double opening : {-1e-6, 2e-6, -2e-6})
                        for (int k = 0; k < 100; ++k) joint.step(opening, way);
                EXPECT_TRUE(std::isfinite(joint.frictional_work[0]));
                EXPECT_GT(joint.normal_force[0], 0);
            }
}

TEST_P(TakesOver, CreatesNoEnergy) {
    // After the change a closed loop of small motions returns at most the stored energy.
    for (const State& s : states) {
        TestJoint joint = with_forces(GetParam(), s, 0.04);
        settle(joint);
        // The energy of its springs, for the curved ones 4/3 of that by their tangent, and the work of the initial force in the step that
        // opens the joint.
        const double limit =
            4.0 / 3 * stored(joint) + 1e-7 * std::hypot(joint.normal_force[0], 0.04 * joint.shear_stress());
        std::mt19937 random(7);
        std::uniform_real_distribution<double> any(-1, 1);
        double put_in = 0, turned_over = 1e-15;
        double a = 0, b = 0, c = 0;
        for (int k = 0; k < 4000; ++k) {
            if (k % 50 == 0) a = any(random), b = any(random), c = any(random);
            const TestJoint before = joint;
            joint.step(1e-7 * a, {1e-7 * b, 1e-7 * c, 0}); // small: a step that opens the joint counts completely
            const double work = test::work_of_step(before, joint);
            put_in += work;
            turned_over += std::abs(work);
            ASSERT_GE(put_in, -limit - 2e-3 * turned_over) << s.name << ' ' << k;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, TakesOver, testing::ValuesIn(laws), [](const auto& made) {
    std::string name = made.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

} // namespace
} // namespace kaya
