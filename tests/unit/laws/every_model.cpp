// Requirements of every joint model that ships: no drift and no created energy.
#include "test_joint.hpp"
#include "laws/stiffness_trial.hpp"

#include <cmath>
#include <ostream>
#include <random>

namespace kaya {
namespace {

using test::shipped;
using test::TestJoint;
using test::Values;
using test::with;

/// A model with values that use all its features. MPa, m, s; stiffnesses about 1e4 MPa/m.
struct Case {
    const char* name;
    const char* model;
    Values values;
    friend std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }
};

const Values springs = {{"stiffness-normal", 1e4}, {"stiffness-shear", 5e3}};
const Values coulomb = with(springs, {{"friction", 35}, {"cohesion", 0.3}, {"tension", 0.1}});
const Values barton = {{"stiffness-normal", 1e5},
                       {"stiffness-shear", 1e4},
                       {"friction-residual", 20},
                       {"jrco", 8},
                       {"jcso", 100},
                       {"sigmac", 150},
                       {"lo", 0.1},
                       {"ln", 0.2}};

const Case cases[] = {
    {"elastic", "elastic", springs},
    {"mohr", "mohr", with(coulomb, {{"dilation", 8}, {"dilation-zero", 2e-3}, {"friction-residual", 30}})},
    {"bilinear", "bilinear-mohr",
     with(coulomb, {{"friction-2", 20}, {"cohesion-2", 1}, {"dilation", 6}, {"dilation-2", 2}})},
    {"softening", "softening-mohr",
     with(coulomb, {{"friction-residual", 25}, {"dc", 5e-4}, {"alpha", 2}, {"dilation", 4}})},
    {"softening_for_good", "softening-mohr", with(coulomb, {{"friction-residual", 25}, {"dc", 5e-4}, {"healing", 0}})},
    {"fracture", "fracture-energy", with(coulomb, {{"friction-residual", 25}, {"g1", 1e-6}, {"g2", 5e-5}})},
    {"fracture_straight", "fracture-energy",
     with(coulomb, {{"g1", 1e-5}, {"g2", 5e-5}, {"straight", 1}, {"compression", 40}, {"cap-shear", 4}})},
    {"yielding",
     "continuously-yielding",
     {{"kn-initial", 1e4}, {"ks-initial", 5e3}, {"friction", 30}, {"friction-initial", 50}, {"roughness", 3e-3}}},
    {"yielding_powers",
     "continuously-yielding",
     {{"kn-initial", 1e4},
      {"ks-initial", 5e3},
      {"friction", 30},
      {"friction-initial", 50},
      {"roughness", 3e-3},
      {"exponent-normal", 0.4},
      {"exponent-shear", 0.6},
      {"dilation", 1}}},
    {"nonlinear", "nonlinear",
     with(coulomb, {{"tension", 0.01},
                    {"exponent-normal", 0.5},
                    {"exponent-shear", 0.7},
                    {"kn-maximum", 3e4},
                    {"dilation", 6},
                    {"friction-residual", 28}})},
    {"power", "power",
     with(coulomb, {{"constant-1", 1e-5},
                    {"exponent-1", 3},
                    {"constant-2", 1e-4},
                    {"exponent-2", 2},
                    {"stress-2", 0.5},
                    {"dilation", 5},
                    {"dilation-residual", 2}})},
    {"velocity", "velocity-weakening",
     with(springs, {{"friction-static", 35},
                    {"friction-dynamic", 15},
                    {"reference-velocity", 0.1},
                    {"exponent", 2},
                    {"cohesion", 0.3},
                    {"dilation", 3}})},
    {"velocity_while_it_slips", "velocity-weakening",
     with(springs,
          {{"friction-static", 35}, {"friction-dynamic", 15}, {"reference-velocity", 0.1}, {"use-plastic", 1}})},
    {"barton_bandis", "barton-bandis", barton},
};

class EveryModel : public testing::TestWithParam<Case> {
protected:
    TestJoint joint(double area = 0.04, std::size_t rows = 1) const {
        return TestJoint(shipped(GetParam().model), GetParam().values, area, rows);
    }
};

/// Sums the work done on row 0, step by step (trapezoid).
class Meter {
public:
    explicit Meter(TestJoint& joint) : joint_(joint), batch_(joint.batch()) {}
    void step(double opening, const test::Vector& slip) {
        const double work_before = work_with_forces(opening, slip);
        joint_.step(opening, slip);
        const double work = 0.5 * (work_before + work_with_forces(opening, slip));
        put_in += work;
        turned_over += std::abs(work);
        least = std::min(least, put_in);
    }
    /// The same for many steps: the model alone, without the guard around it.
    void run(double opening, double slip) {
        auto& j = joint_;
        j.normal_disp_inc[0] = opening;
        j.shear_disp_inc[0][0] = slip;
        const double before = -j.normal_force[0] * opening - j.shear_force[0][0] * slip;
        j.model->descriptor().run(&batch_);
        const double work = 0.5 * (before - j.normal_force[0] * opening - j.shear_force[0][0] * slip);
        j.normal_disp[0] += opening;
        j.shear_disp[0][0] += slip;
        put_in += work;
        turned_over += std::abs(work);
        least = std::min(least, put_in);
    }
    double put_in = 0, turned_over = 0, least = 0;

private:
    double work_with_forces(double opening, const test::Vector& slip) const {
        double work = -joint_.normal_force[0] * opening;
        for (int k = 0; k < 3; ++k) work -= joint_.shear_force[k][0] * slip[k];
        return work;
    }
    TestJoint& joint_;
    kaya_jbatch batch_;
};

TEST_P(EveryModel, IsAsStiffAsItSays) {
    const auto& model = shipped(GetParam().model);
    EXPECT_GT(initial_stiffness(model, test::values_of(model, GetParam().values)).normal, 0);
}

TEST_P(EveryModel, IsInItsPlaceAfterFiftyUnloadings) {
    auto j = joint();
    j.load(1);
    const double closed = j.normal_disp[0];
    for (int cycle = 0; cycle < 50; ++cycle) {
        for (int k = 0; k < 20; ++k) j.step(0.9e-6);
        for (int k = 0; k < 20; ++k) j.step(-0.9e-6);
        ASSERT_NEAR(j.normal_stress(), 1, 1e-9) << cycle;
    }
    EXPECT_NEAR(j.normal_disp[0], closed, 1e-15);
}

TEST_P(EveryModel, IsInItsPlaceAfterOpeningAndClosingAgain) {
    auto j = joint();
    j.load(1);
    for (int cycle = 0; cycle < 50; ++cycle) {
        for (int k = 0; k < 30; ++k) j.step(3e-5, {1e-6, 0, 0});
        if (std::string(GetParam().model) != "elastic") {
            EXPECT_LE(j.normal_stress(), 0) << cycle;
            EXPECT_EQ(j.shear_stress(), 0) << cycle; // an open joint carries no shear
        }
        for (int k = 0; k < 30; ++k) j.step(-3e-5, {-1e-6, 0, 0});
        // Slip during closure may dilate: this compresses, and never pulls.
        EXPECT_GE(j.normal_stress(), 1 - 1e-9) << cycle;
        EXPECT_LE(j.normal_stress(), 1.6) << cycle;
    }
}

TEST_P(EveryModel, MakesNoEnergyInCyclesOfShear) {
    for (const double size : {2e-5, 3e-4, 2e-3}) {
        auto j = joint();
        Meter meter(j);
        for (int k = 0; k < 100; ++k) meter.step(-1e-6, {0, 0, 0});
        double before = meter.put_in;
        const auto shear = [&](int steps, double way) {
            for (int k = 0; k < steps; ++k) meter.step(0, {way / steps, 0, 0});
        };
        for (int cycle = 0; cycle < 6; ++cycle) {
            shear(1000, size);
            shear(300, -0.3 * size); // a small reversal within the large one
            shear(300, 0.3 * size);
            shear(2000, -2 * size);
            shear(1000, size);
            // The first cycle stores energy; from then on a cycle dissipates some or none.
            if (cycle > 0) { EXPECT_GE(meter.put_in, before - 1e-6 * meter.turned_over) << size << ' ' << cycle; }
            before = meter.put_in;
        }
        EXPECT_GE(meter.least, 0) << size;
    }
}

TEST_P(EveryModel, NeverReturnsMoreEnergyThanItReceived) {
    // Random motion in all three directions, with opening and closing: for any path, the work done is stored or dissipated.
    for (unsigned seed = 1; seed <= 8; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> any(-1, 1);
        auto j = joint();
        Meter meter(j);
        double a = any(random), b = any(random), c = any(random);
        double closed = 0;
        for (int k = 0; k < 20000; ++k) {
            if (k % 97 == 0) a = any(random), b = any(random), c = any(random);
            const double opening = 1e-6 * (a - (closed < 0 ? 0.3 : closed > 2e-4 ? -0.3 : 0));
            closed -= opening;
            meter.step(opening, {2e-6 * b, 2e-6 * c, 0});
        }
        EXPECT_GE(meter.least, -1e-4 * meter.turned_over) << seed;
        // The reported dissipation never exceeds the work done.
        EXPECT_LE(j.frictional_work[0], meter.put_in + 1e-3 * meter.turned_over) << seed;
    }
}

TEST_P(EveryModel, StaysWhereItIsInManyCyclesOfSmallLoad) {
    auto j = joint();
    j.load(1);
    for (int k = 0; k < 20; ++k) j.step(0, {1e-6, 0, 0});
    Meter meter(j);
    // An ellipse about the load, in eight steps: normal and shear load oscillate with a phase difference.
    struct Step {
        double opening, slip;
    } way[8];
    for (int k = 0; k < 8; ++k) {
        const double from = M_PI / 4 * k, to = M_PI / 4 * (k + 1);
        way[k] = {1e-7 * (std::cos(to) - std::cos(from)), 4e-7 * (std::sin(to + 1) - std::sin(from + 1))};
    }
    const auto cycles = [&](int n) {
        for (int i = 0; i < n; ++i)
            for (const auto& s : way) meter.run(s.opening, s.slip);
    };
    cycles(1000);
    const double normal = j.normal_stress(), shear = j.shear_stress(), before = meter.put_in;
    const double stored = 0.5 * shear * shear / j.shear_stiffness[0] * j.area[0];
    cycles(124'000);
    // The limit for a million cycles is 1e-8; drift grows with their number.
    constexpr double drift = 1.25e-9;
    EXPECT_NEAR(j.normal_stress(), normal, drift);
    // Creep and hysteresis may reduce the mean shear stress and release its stored energy; it must not increase.
    EXPECT_LE(j.shear_stress(), shear + drift);
    EXPECT_GE(meter.put_in, before - stored - 1e-9 * meter.turned_over);
    const std::string name = GetParam().model;
    if (name == "elastic" || name.ends_with("mohr")) { EXPECT_NEAR(j.shear_stress(), shear, drift); }
}

TEST_P(EveryModel, GivesTheSameBitsInEveryRow) {
    auto j = joint(0.3, 37);
    for (int k = 0; k < 500; ++k)
        j.step(2e-6 * (std::sin(0.05 * k) - 0.4), {6e-6 * std::cos(0.011 * k), 4e-6 * std::sin(0.017 * k), 0});
    for (std::size_t i = 1; i < 37; ++i) {
        EXPECT_EQ(j.normal_force[i], j.normal_force[0]);
        EXPECT_EQ(j.shear_force[0][i], j.shear_force[0][0]);
        EXPECT_EQ(j.shear_force[1][i], j.shear_force[1][0]);
        EXPECT_EQ(j.frictional_work[i], j.frictional_work[0]);
        EXPECT_EQ(j.state[i], j.state[0]);
        for (const auto& column : j.history) EXPECT_EQ(column[i], column[0]);
    }
}

TEST_P(EveryModel, AcceptsAnAreaOfZero) {
    auto j = joint(0);
    for (int k = 0; k < 100; ++k) j.step(k < 50 ? -1e-6 : 2e-6, {1e-5, 0, 0});
    EXPECT_EQ(j.normal_force[0], 0);
    EXPECT_EQ(j.shear_force[0][0], 0);
}

TEST_P(EveryModel, KnowsTheWordsOfDecks) {
    const auto& model = shipped(GetParam().model);
    for (const char* word : {"jkn", "jks"}) EXPECT_TRUE(model.find_property(word)) << word;
    if (!model.find_property("cohesion")) return; // the rest are properties of Coulomb joints
    for (const char* word : {"jfric", "jcoh", "jten", "friction", "tension"})
        EXPECT_TRUE(model.find_property(word)) << word;
    if (model.name == "fracture-energy") return; // the bond does not dilate
    for (const char* word : {"jdil", "zdil", "dilation", "dilation-zero"})
        EXPECT_TRUE(model.find_property(word)) << word;
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryModel, testing::ValuesIn(cases),
                         [](const auto& made) { return std::string(made.param.name); });

} // namespace
} // namespace kaya
