#include "slopes/turning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace kaya {
namespace {

constexpr double degree = std::numbers::pi / 180;
const Vec3 weight(0, 0, -1), none = Vec3::Zero();

/// Corners of a level floor from x = -1 to `end`, relative to the centre of a block above it.
std::vector<RestingCorner> floor_to(double end, const Coulomb& strength) {
    std::vector<RestingCorner> corners;
    for (const double x : {-1.0, end})
        for (const double y : {-1.0, 1.0}) corners.push_back({{0, 0, -1}, {x, y, -0.7}, 1, strength});
    return corners;
}

TEST(Turning, ABlockTipsOverTheEdgeOfAFloorThatEndsBeforeItsCentre) {
    for (const double friction : {0.0, 1.0}) {
        EXPECT_FALSE(turning_factor(weight, none, floor_to(0.01, {0, friction})));
        EXPECT_EQ(turning_factor(weight, none, floor_to(-0.01, {0, friction})), 0);
    }
    EXPECT_EQ(turning_factor(weight, Vec3(0, 0.02, 0), floor_to(0.01, {})), 0) << "a load turns it over the edge";
    EXPECT_FALSE(turning_factor(weight, none, {})) << "what touches nothing does not turn";
}

TEST(Turning, FrictionHoldsABlockInANotchOffItsMiddle) {
    // Lines of reaction at 45 degrees, plus and minus the friction angle, intersect below the weight: sin(2 friction) = d.
    for (const double d : {0.1, 0.5, 0.9}) {
        const double needed = std::tan(0.5 * std::asin(d)), friction = std::tan(40 * degree);
        for (const double turn : {0.0, 0.3, 1.1}) {
            const auto turned = [&](const Vec3& v) -> Vec3 {
                return {std::cos(turn) * v.x() - std::sin(turn) * v.y(),
                        std::sin(turn) * v.x() + std::cos(turn) * v.y(), v.z()};
            };
            std::vector<RestingCorner> notch;
            for (const double side : {-1.0, 1.0})
                for (const double y : {-2.0, 2.0})
                    notch.push_back(
                        {turned(Vec3(side, 0, -1).normalized()), turned({side - d, y, -0.4}), 1, {0, friction}});
            const auto factor = turning_factor(3 * weight, none, notch);
            ASSERT_TRUE(factor);
            EXPECT_LE(*factor, friction / needed * (1 + 1e-4));
            EXPECT_GE(*factor, friction / needed * 0.98) << "16 directions of shear";
        }
    }
}

TEST(Turning, CohesionHoldsATwist) {
    const double arm = std::sqrt(2), cohesion = 3, twist = 2;
    for (const double unit : {1.0, 1e-6, 1e6}) {
        auto corners = floor_to(1, {unit * cohesion, 0});
        const auto factor = turning_factor(unit * weight, Vec3(0, 0, unit * twist), corners);
        ASSERT_TRUE(factor);
        EXPECT_NEAR(*factor, 4 * cohesion * arm / twist, 0.02 * *factor);
        for (auto& corner : corners) corner.strength = {};
        EXPECT_EQ(turning_factor(unit * weight, Vec3(0, 0, unit * twist), corners), 0);
    }
}

} // namespace
} // namespace kaya
