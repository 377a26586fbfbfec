// Dilation over paths that reverse: it increases as slip leads away from its origin, and decreases as slip returns.
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
using test::Vector;

double tan_degrees(double angle) { return std::tan(angle * std::numbers::pi / 180); }

/// 1 MPa and 1 m in the units of a deck.
struct Units {
    double stress, length;
};
constexpr Units mpa{1, 1};
constexpr Units units[] = {mpa, {1e6, 1}, {1, 1e3}};

constexpr double angle = 8;

struct Case {
    const char* model;
    Values values; ///< MPa, m
    friend std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.model; }
};
const Case cases[] = {
    {"mohr", {}},
    {"bilinear-mohr", {{"friction-2", 20}, {"cohesion-2", 3}, {"cohesion-2-residual", 3}, {"dilation-2", 3}}},
    {"softening-mohr", {{"dc", 1e-3}, {"friction-residual", 25}}},
    {"nonlinear", {}},
    {"power", {{"dilation-residual", angle}}},
    {"velocity-weakening", {{"reference-velocity", 1}, {"friction-dynamic", 30}}},
};

TestJoint joint_of(const Case& c, double end, const Units& u = mpa, double ks = 5e3) {
    Values values = {{"jkn", 1e4 * u.stress / u.length},
                     {"jks", ks * u.stress / u.length},
                     {"jfric", 35},
                     {"jdil", angle},
                     {"zdil", end * u.length}};
    for (const auto& [name, value] : c.values) {
        const bool is_stress = name.starts_with("cohesion"), is_length = name == "dc" || name == "reference-velocity";
        values[name] = value * (is_stress ? u.stress : is_length ? u.length : 1);
    }
    return TestJoint(shipped(c.model), values, 0.04 * u.length * u.length);
}

double distance(const TestJoint& j) {
    return std::hypot(j.history_value("dilating-x"), j.history_value("dilating-y"), j.history_value("dilating-z"));
}

class DilationOnAPath : public testing::TestWithParam<Case> {};

TEST_P(DilationOnAPath, ComesDownWhenTheSlipGoesBackAtAConstantStress) {
    for (const double end : {0.0, 1e-3}) {
        auto joint = joint_of(GetParam(), end);
        joint.load(1);
        const double rest = joint.normal_disp[0];
        double highest = 0;
        for (int cycle = 0; cycle < 10; ++cycle)
            for (const double way : {2e-3, -4e-3, 2e-3}) {
                for (int k = 0; k < 40; ++k) joint.slip_at_stress(1, {way / 40, 0, 0});
                const double open = joint.normal_disp[0] - rest;
                highest = std::max(highest, open);
                // By its position, not by the length of its path.
                const double climbed = std::min(distance(joint), end > 0 ? end : 1) * tan_degrees(angle);
                EXPECT_NEAR(open, climbed, 1e-9) << cycle;
                EXPECT_NEAR(joint.history_value("dilated"), open, 1e-9);
            }
        EXPECT_GT(highest, 0.9 * (end > 0 ? end : 2e-3 - 2e-4) * tan_degrees(angle));
        EXPECT_LT(highest, 2.05e-3 * tan_degrees(angle));
        EXPECT_GT(joint.history_value("slip"), 7e-2);
    }
}

TEST_P(DilationOnAPath, StaysWithinItsAngleOnAnyPathInThePlane) {
    for (unsigned seed = 1; seed <= 4; ++seed)
        for (const double end : {0.0, 6e-4}) {
            std::mt19937 random(seed);
            std::uniform_real_distribution<double> any(-1, 1);
            auto joint = joint_of(GetParam(), end);
            joint.load(1);
            double a = 0, b = 0, c = 0, turned_over = 0, given = 0.5 * 0.04 / 1e4; // by the load
            for (int k = 0; k < 20000; ++k) {
                if (k % 400 == 0)
                    a = any(random), b = any(random),
                    c = 0.2 * any(random) - 0.02 * (joint.normal_stress() < 0.5 ? 8 : -1);
                const TestJoint before = joint;
                joint.step(1e-6 * c, {3e-6 * a, 3e-6 * b, 0});
                const double work = test::work_of_step(before, joint);
                given += work;
                turned_over += std::abs(work);
                const double most = std::min(distance(joint), end > 0 ? end : 1) * tan_degrees(angle);
                ASSERT_GE(joint.history_value("dilated"), -1e-12) << k;
                ASSERT_LE(joint.history_value("dilated"), most * (1 + 1e-6) + 1e-9) << k;
                ASSERT_GE(given, -1e-3 * turned_over) << seed << ' ' << k;
                ASSERT_LE(joint.frictional_work[0], given + 1e-3 * turned_over + 1e-9);
            }
        }
}

TEST_P(DilationOnAPath, IsTheSameInEveryDirectionAndUnit) {
    auto plain = joint_of(GetParam(), 1e-3);
    plain.load(1);
    std::vector<TestJoint> others;
    for (const Units& u : units) {
        others.push_back(joint_of(GetParam(), 1e-3, u));
        others.back().load(u.stress);
    }
    const double c = std::cos(1.1), s = std::sin(1.1);
    for (int k = 0; k < 4000; ++k) {
        const double x = 2e-6 * std::cos(0.004 * k), y = 1e-6 * std::sin(0.0031 * k),
                     opening = 1e-7 * std::sin(0.01 * k);
        plain.step(opening, {x, y, 0});
        for (std::size_t i = 0; i < others.size(); ++i) {
            const Units& u = units[i];
            others[i].step(opening * u.length, {(x * c - y * s) * u.length, 0, (x * s + y * c) * u.length});
            ASSERT_NEAR(others[i].normal_stress() / u.stress, plain.normal_stress(), 1e-7 * (1 + plain.normal_stress()))
                << k;
            ASSERT_NEAR(others[i].shear_stress() / u.stress, plain.shear_stress(), 1e-7 * (1 + plain.shear_stress()))
                << k;
        }
    }
    EXPECT_GT(distance(plain), 2e-5);
}

TEST_P(DilationOnAPath, ALockedJointFindsItsNormalForceAgain) {
    // The sides cannot separate: the normal stress increases with slip and decreases on return. With the last stiffness the strength
    // decreases faster than the spring: the joint snaps back.
    for (const double ks : {5e3, 2e3, 500.0}) {
        auto joint = joint_of(GetParam(), 0, mpa, ks);
        joint.load(1);
        const auto shear_to = [&](double distance_wanted, double by) {
            for (int k = 0; k < 100000 && (distance(joint) - distance_wanted) * by < 0; ++k) joint.step(0, {by, 0, 0});
        };
        shear_to(1e-3, 1e-6);
        EXPECT_GT(joint.normal_stress(), 1.3);
        const double slipped = joint.history_value("slip");
        for (int k = 0; k < 100000 && joint.history_value("dilating-x") > 0; ++k) joint.step(0, {-1e-6, 0, 0});
        EXPECT_GT(joint.history_value("slip"), slipped);
        EXPECT_NEAR(joint.normal_stress(), 1 + 1e4 * joint.history_value("dilated"), 1e-6) << ks; // at any time
        if (ks > 1e3) { EXPECT_NEAR(joint.normal_stress(), 1, 0.01) << ks; }
        EXPECT_NEAR(joint.history_value("dilated"), distance(joint) * tan_degrees(angle), 1e-9) << ks;
        EXPECT_TRUE(std::isfinite(joint.frictional_work[0]));
    }
}

TEST_P(DilationOnAPath, SidesThatComeDownWithoutLoadPart) {
    // Sheared under load, almost unloaded, held there and sheared back: no tension, and closed again at its origin.
    auto joint = joint_of(GetParam(), 0);
    joint.load(1);
    const double rest = joint.normal_disp[0];
    for (int k = 0; k < 300; ++k) joint.slip_at_stress(1, {5e-6, 0, 0});
    joint.load(1e-3);
    for (int k = 0; k < 1500; ++k) {
        joint.step(0, {-1e-6, 0, 0});
        ASSERT_GE(joint.normal_force[0], 0);
    }
    joint.load(1);
    const double climbed = distance(joint) * tan_degrees(angle);
    EXPECT_LE(joint.normal_disp[0] - rest, climbed + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Shipped, DilationOnAPath, testing::ValuesIn(cases), [](const auto& made) {
    std::string name = made.param.model;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

} // namespace
} // namespace kaya
