#include "base/units.hpp"

#include "base/diagnostic.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace kaya {
namespace {

TEST(Units, LabelQuantities) {
    const Units si("si");
    EXPECT_EQ(si.label("length"), "m");
    EXPECT_EQ(si.label("stress/length"), "Pa/m");
    EXPECT_EQ(si.label("mass/length^3"), "kg/m^3");
    EXPECT_EQ(si.label("length^4"), "m^4");
    EXPECT_EQ(si.label("moment/length"), "N*m/m");
    EXPECT_EQ(si.label("angle in radians/time"), "angle in rad/s");
    EXPECT_EQ(si.label("-"), "-");
    EXPECT_EQ(Units("MPa-m").label("density"), "kt/m^3");
    EXPECT_EQ(Units("in lb s psi").label("force/velocity"), "lbf/(in/s)");
    EXPECT_EQ(Units().label("stress"), "stress");
    EXPECT_EQ(si.in_brackets("2:force [force, block nearest to 0 0 0]"), "2:force [N, block nearest to 0 0 0]");
    EXPECT_EQ(si.in_brackets("displacement [length"), "displacement [m");
    EXPECT_EQ(si.in_brackets("no unit"), "no unit");
}

TEST(Units, UnitsHaveAnyOrder) {
    EXPECT_EQ(Units("t mm s MPa").name(), "mm-t-s");
    EXPECT_EQ(Units("Pa-s-kg-m").name(), "si");
    for (const char* some : {"mm-t", "s-MPa-m", "m-kg-s-Pa", "psf"}) EXPECT_TRUE(Units::fit(some)) << some;
    for (const char* other : {"m-lbf", "si", "si-m", "m-m", "mm-t-s-small"}) EXPECT_FALSE(Units::fit(other)) << other;
}

TEST(Units, UnknownSystemsAreRefused) {
    for (const char* name : {"", "metric", "m-kg", "si si"}) EXPECT_THROW(Units{name}, Diagnostic) << name;
}

// The same rock in every system.
TEST(Units, FitTogether) {
    const struct {
        const char* name;
        double density, modulus, gravity;
    } rocks[] = {{"si", 2700, 1e9, 9.81},
                 {"kpa-m", 2.7, 1e6, 9.81},
                 {"mpa-m", 2.7e-3, 1e3, 9.81},
                 {"mm-t-s", 2.7e-9, 1e3, 9810},
                 {"cm-g-s", 2.7, 1e10, 981},
                 {"in-lb", 2.52647e-4, 1.450377e5, 386.2205},
                 {"ft-lb", 5.238865, 2.0885434e7, 32.185039}};
    for (const auto& rock : rocks) {
        const Units units(rock.name);
        EXPECT_NEAR(units.density_in_si(rock.density), 2700, 0.02) << rock.name;
        EXPECT_NEAR(units.stress_in_si(rock.modulus), 1e9, 1e3) << rock.name;
        EXPECT_NEAR(units.acceleration_in_si(rock.gravity), 9.81, 1e-5) << rock.name;
    }
    EXPECT_EQ(Units::names().size(), std::size(rocks));
}

} // namespace
} // namespace kaya
