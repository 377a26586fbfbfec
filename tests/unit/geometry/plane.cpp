#include "geometry/polyhedra/plane.hpp"

#include <gtest/gtest.h>

using namespace kaya;

TEST(Plane, NormalFollowsDipAndDipDirection) {
    EXPECT_EQ(normal_from_dip(0, 0), Vec3(0, 0, 1));
    EXPECT_EQ(normal_from_dip(0, 123), Vec3(0, 0, 1));
    EXPECT_EQ(normal_from_dip(90, 90), Vec3(1, 0, 0));
    EXPECT_EQ(normal_from_dip(90, 0), Vec3(0, 1, 0));
    EXPECT_EQ(normal_from_dip(90, 180), Vec3(0, -1, 0));
    EXPECT_EQ(normal_from_dip(90, 270), Vec3(-1, 0, 0));
    EXPECT_EQ(normal_from_dip(90, -90), Vec3(-1, 0, 0));
    EXPECT_LT((normal_from_dip(30, 0) - Vec3(0, 0.5, std::sqrt(0.75))).norm(), 1e-15);
    const Vec3 n = normal_from_dip(37, 211);
    EXPECT_LT((n - Vec3(-0.30995765, -0.51585616, 0.79863551)).norm(), 1e-7);
    EXPECT_NEAR(n.norm(), 1, 1e-15);
}
