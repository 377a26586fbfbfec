#include "geometry/mesh/edge_field.hpp"

#include "base/diagnostic.hpp"
#include "geometry/surface/shapes.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

using namespace kaya;

namespace {

EdgeField field() { return {2, {1, 2, 3}, 0.2, 1, 4}; }

} // namespace

TEST(EdgeField, GrowsFromTheCentreToTheFarValue) {
    const Vec3 along = Vec3(1, -2, 2) / 3;
    const auto at = [&](double r) { return field().at(field().center + r * along); };
    EXPECT_NEAR(at(0), 0.2, 1e-12);
    EXPECT_NEAR(at(1), 0.4, 1e-12);
    EXPECT_NEAR(at(4), 1, 1e-12);
    EXPECT_NEAR(at(6), 1.5, 1e-12); // a quarter of the distance, because 0.2 is less
    EXPECT_NEAR(at(8), 2, 1e-12);
    EXPECT_EQ(at(100), 2);
    const EdgeField coarse(0.5, {0, 0, 0}, 4, 2, 1); // finer outside
    EXPECT_NEAR(coarse.at({1.5, 0, 0}), 1, 1e-12);
    EXPECT_EQ(coarse.at({9, 0, 0}), 0.5);
    EXPECT_EQ(EdgeField(0.7).at({5, 5, 5}), 0.7);
}

TEST(EdgeField, AnEdgeIsDividedAsTheFieldSaysFromBothItsEnds) {
    const Vec3 a(1, 2, 3), b(1, 2, 7);
    const EdgeParts parts(field(), a, b);
    // The integral of ds / (0.2 + 0.2 s) from 0 to 4 is 5 ln 5.
    EXPECT_NEAR(parts.mean(), 5 * std::log(5.0), 1e-3);
    const std::vector<double> there = parts.division(8), back = EdgeParts(field(), b, a).division(8);
    ASSERT_EQ(there.size(), 9u);
    for (std::size_t i = 0; i <= 8; ++i) {
        // Where 5 ln(1 + s) is i / 8 of the whole.
        EXPECT_NEAR(4 * there[i], std::pow(5.0, static_cast<double>(i) / 8) - 1, 2e-3) << i;
        EXPECT_NEAR(there[i], 1 - back[8 - i], 1e-12) << i;
        EXPECT_NEAR(parts.division(8, true)[i], back[i], 1e-12) << i;
    }
}

TEST(EdgeField, CountsCubesNearTheCentreWithoutVisitingAll) {
    // In a ball of radius 4: the integral of 4 pi r^2 / (0.2 + 0.2 r)^3, which is 500 pi (ln 5 - 2 + 1/5 * 2 + 12/25).
    const double u = 5, exact = 500 * M_PI * (std::log(u) + 2 / u - 1 / (2 * u * u) - 1.5);
    double sum = 0; // of shells, as a check of the closed form
    for (int i = 0; i < 100000; ++i) {
        const double r = 4 * (i + 0.5) / 100000;
        sum += 4 * M_PI * r * r * 4e-5 / std::pow(0.2 + 0.2 * r, 3);
    }
    EXPECT_NEAR(sum, exact, 1e-4 * exact);
    const Polyhedron cube = make_brick({-3, -2, -1}, {5, 6, 7}); // of 8 m around the centre
    EXPECT_GT(field().cubes_in(cube), 0.5 * exact);
    EXPECT_LT(field().cubes_in(cube), 2 * exact);
    EXPECT_NEAR(EdgeField(0.5).cubes_in(cube), 4096, 1e-6);
}

TEST(EdgeField, RefusesInvalidLengths) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    for (const double wrong : {0.0, -1.0, nan, inf}) {
        EXPECT_THROW(EdgeField(wrong).check(), Diagnostic) << wrong;
        EXPECT_THROW(EdgeField(1, {0, 0, 0}, wrong, 1, 5).check(), Diagnostic) << wrong;
        EXPECT_THROW(EdgeField(1, {0, 0, 0}, 1, wrong, 5).check(), Diagnostic) << wrong;
    }
    EXPECT_THROW(EdgeField(1, {0, 0, 0}, 1, 3, 1).check(), Diagnostic); // too steep
    EXPECT_THROW(EdgeField(1, {0, 0, 0}, 1, 1, nan).check(), Diagnostic);
    EXPECT_THROW(EdgeField(1, {nan, 0, 0}, 1, 1, 5).check(), Diagnostic);
    field().check();
}
