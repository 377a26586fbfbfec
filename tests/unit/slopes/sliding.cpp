#include "slopes/sliding.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>
#include <random>

namespace kaya {
namespace {

const Strength friction_30 = Strength::coulomb(0, 30);
const Vec3 weight(0, 0, -1);

HeldFace face(const Vec3& outward, double area = 1) { return {outward.normalized(), area, &friction_30}; }

TEST(Sliding, ModesOfSimpleBlocks) {
    EXPECT_EQ(slide(weight, {}).mode, SlidingMode::falling);
    const std::vector<HeldFace> floor{face({0, 0, -1})};
    EXPECT_EQ(slide(weight, floor).mode, SlidingMode::at_rest) << "on a level floor";
    const std::vector<HeldFace> roof{face({0, 0, 1})};
    EXPECT_EQ(slide(weight, roof).mode, SlidingMode::falling);
    EXPECT_EQ(slide(weight, roof).factor, 0);
    const std::vector<HeldFace> box{face({1, 0, 0}),  face({-1, 0, 0}), face({0, 1, 0}),
                                    face({0, -1, 0}), face({0, 0, 1}),  face({0, 0, -1})};
    EXPECT_EQ(slide(weight, box).mode, SlidingMode::held);
    const std::vector<HeldFace> shaft(box.begin(), box.begin() + 4);
    EXPECT_EQ(slide(weight, shaft).mode, SlidingMode::one_plane) << "between upright walls that carry nothing";
}

TEST(Sliding, APlaneAndItsFactor) {
    const double dip = 0.6;
    const std::vector<HeldFace> plane{face({-std::sin(dip), 0, -std::cos(dip)})};
    const SlidingAnswer answer = slide(weight, plane);
    ASSERT_EQ(answer.mode, SlidingMode::one_plane);
    EXPECT_NEAR(*answer.factor, std::tan(std::numbers::pi / 6) / std::tan(dip), 1e-12);
    EXPECT_NEAR((answer.direction - Vec3(std::cos(dip), 0, -std::sin(dip))).norm(), 0, 1e-12);
}

/// The direction nearest to the force, by small steps over the cone: slow, and independent of the tested method.
double best_dot(const Vec3& force, const std::vector<HeldFace>& faces) {
    double best = 0;
    constexpr int steps = 160;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const double polar = std::numbers::pi * i / steps, around = std::numbers::pi * j / steps;
            const Vec3 v(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
            if (std::ranges::all_of(faces, [&](const HeldFace& f) { return f.outward.dot(v) <= 0; }))
                best = std::max(best, force.dot(v));
        }
    return best;
}

TEST(Sliding, RandomConesMoveWhereTheForceGoesFarthest) {
    std::mt19937 random(20261123);
    std::normal_distribution<double> normal;
    int held = 0, moved = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<HeldFace> faces;
        const int count = 1 + trial % 6;
        for (int k = 0; k < count; ++k) faces.push_back(face({normal(random), normal(random), normal(random)}, 2));
        const SlidingAnswer answer = slide(weight, faces);
        const double best = best_dot(weight, faces),
                     found = answer.direction.isZero() ? 0 : weight.dot(answer.direction);
        EXPECT_GE(found, best - 1e-9) << trial;
        EXPECT_LE(found, best + 0.05) << trial << ": the net of directions is two degrees wide";
        for (const HeldFace& f : faces) EXPECT_LE(f.outward.dot(answer.direction), 2e-6) << trial;
        (answer.mode == SlidingMode::held ? held : moved) += 1;
        // Rotated as a whole it gives the same result.
        const Mat3 turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                              .normalized()
                              .toRotationMatrix();
        std::vector<HeldFace> turned = faces;
        for (HeldFace& f : turned) f.outward = turn * f.outward;
        std::ranges::reverse(turned);
        const SlidingAnswer again = slide(turn * weight, turned);
        EXPECT_EQ(again.mode, answer.mode) << trial;
        EXPECT_NEAR((again.direction - turn * answer.direction).norm(), 0, 1e-9) << trial;
        if (answer.factor) { EXPECT_NEAR(*again.factor, *answer.factor, 1e-9 * (1 + *answer.factor)) << trial; }
    }
    EXPECT_GT(held, 20);
    EXPECT_GT(moved, 100);
}

} // namespace
} // namespace kaya
