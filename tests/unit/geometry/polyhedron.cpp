#include "geometry/polyhedra/polyhedron.hpp"

#include "base/diagnostic.hpp"
#include "geometry/surface/shapes.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace kaya;

TEST(MassProperties, RegularTetrahedronOfEdgeOne) {
    const double h = std::sqrt(2.0 / 3), r = std::sqrt(1.0 / 3);
    const Polyhedron p = make_tetrahedron({Vec3(r, 0, 0), Vec3(-r / 2, 0.5, 0), Vec3(-r / 2, -0.5, 0), Vec3(0, 0, h)});
    const MassProperties m = mass_properties(p);
    EXPECT_NEAR(m.volume, 1 / (6 * std::sqrt(2.0)), 1e-12 * m.volume);
    EXPECT_LT((m.centroid - Vec3(0, 0, h / 4)).norm(), 1e-15);
    EXPECT_LT((m.inertia - m.volume / 20 * Mat3::Identity()).norm(), 1e-12 * m.volume / 20);
}

TEST(MassProperties, RightTetrahedronWithLegsOne) {
    const MassProperties m =
        mass_properties(make_tetrahedron({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}));
    EXPECT_NEAR(m.volume, 1.0 / 6, 1e-12 / 6);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(m.centroid[i], 0.25, 1e-15);
        EXPECT_NEAR(m.inertia(i, i), 3 * m.volume / 40, 1e-12 * m.volume);
        // The off-diagonal term is minus the product integral, which is -m/80.
        EXPECT_NEAR(m.inertia(i, (i + 1) % 3), m.volume / 80, 1e-12 * m.volume);
    }
}

TEST(MassProperties, DoNotDependOnTheDistanceFromTheOrigin) {
    const MassProperties here = mass_properties(make_brick({0, 0, 0}, {1, 2, 4}));
    const MassProperties there = mass_properties(make_brick({1024, -2048, 4096}, {1025, -2046, 4100}));
    EXPECT_NEAR(there.volume, here.volume, 1e-12);
    EXPECT_LT((there.inertia - here.inertia).norm(), 1e-11);
    EXPECT_NEAR(here.inertia(0, 0), 8.0 * (4 + 16) / 12, 1e-13);
}

TEST(Brick, LimitsMayComeInAnyOrderButNotBeEqual) {
    EXPECT_EQ(mass_properties(make_brick({1, 0, 3}, {0, 2, 0})).volume, 6);
    try {
        make_brick({0, 1, 0}, {1, 1, 1});
        FAIL() << "a brick without thickness was accepted";
    } catch (const Diagnostic& diagnostic) {
        EXPECT_EQ(diagnostic.message, "the brick has no size in y: both limits are 1");
    }
}
