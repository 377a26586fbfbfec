// Blocks cut by the surface of a body or by an open surface: volumes, sides, and the same in any frame and scale.
#include "geometry/surface/surface_cuts.hpp"

#include "base/diagnostic.hpp"
#include "closed.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

using namespace kaya;
using kaya::test::closed;

namespace {

/// A frame and a scale.
struct Frame {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Vec3 move = Vec3::Zero();
    double scale = 1;
    Vec3 operator()(const Vec3& v) const { return scale * (turn * v) + move; }
    Polyhedron operator()(Polyhedron block) const {
        for (Vec3& v : block.vertices) v = (*this)(v);
        if (turn.determinant() < 0)
            for (auto& face : block.faces) std::reverse(face.vertices.begin(), face.vertices.end());
        return block;
    }
    Surface operator()(Surface surface) const {
        for (Vec3& v : surface.vertices) v = (*this)(v);
        return surface;
    }
};

std::vector<Frame> frames() {
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()).toRotationMatrix();
    const Eigen::Matrix3d mirrored = Vec3(1, -1, 1).asDiagonal();
    return {{},
            {turned},
            {mirrored},
            {turned * mirrored, Vec3(1e6, -2e6, 1e5)},
            {Eigen::Matrix3d::Identity(), Vec3::Zero(), 1e-3}};
}

/// A ball of triangles, with dents that make it concave.
Surface dented_ball(double radius, int rings = 5, int sides = 8) {
    Surface ball;
    const auto add = [&](double up, double around, double size) {
        ball.vertices.push_back(size *
                                Vec3(std::sin(up) * std::cos(around), std::sin(up) * std::sin(around), std::cos(up)));
    };
    add(0, 0, radius);
    for (int i = 1; i < rings; ++i)
        for (int j = 0; j < sides; ++j)
            add(i * std::numbers::pi / rings, 2 * std::numbers::pi * j / sides,
                (i + j) % 3 == 0 ? 0.7 * radius : radius);
    add(std::numbers::pi, 0, radius);
    const int last = static_cast<int>(ball.vertices.size()) - 1;
    const auto at = [&](int i, int j) { return 1 + (i - 1) * sides + j % sides; };
    const auto face = [&](int a, int b, int c) { ball.faces.push_back({{a, b, c}, 0, "face"}); };
    for (int j = 0; j < sides; ++j) {
        face(0, at(1, j), at(1, j + 1));
        face(last, at(rings - 1, j + 1), at(rings - 1, j));
        for (int i = 1; i + 1 < rings; ++i) {
            face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return ball;
}

double volume_of(const Surface& surface) {
    double sum = 0;
    for (const auto& face : surface.faces)
        sum += surface.vertices[face.vertices[0]].dot(
                   surface.vertices[face.vertices[1]].cross(surface.vertices[face.vertices[2]])) /
               6;
    return sum;
}

/// A folded sheet that overhangs: the curve (x, z), drawn along y.
Surface sheet(const std::vector<std::array<double, 2>>& curve, double from, double to) {
    Surface surface;
    for (const auto& [x, z] : curve)
        for (const double y : {from, to}) surface.vertices.emplace_back(x, y, z);
    for (int i = 0; i + 1 < static_cast<int>(curve.size()); ++i) {
        surface.faces.push_back({{2 * i, 2 * i + 2, 2 * i + 3}, 0, "face"});
        surface.faces.push_back({{2 * i, 2 * i + 1, 2 * i + 3}, 0, "face"});
    }
    return surface;
}
const std::vector<std::array<double, 2>> overhanging{{-4, -1}, {0, -0.8}, {1, -0.2}, {-1, 0.3}, {0.2, 0.8}, {4, 1}};

std::vector<Polyhedron> bricks(double half, int n) {
    std::vector<Polyhedron> blocks;
    const double step = 2 * half / n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const Vec3 low = Vec3(i, j, k) * step - Vec3::Constant(half);
                blocks.push_back(make_brick(low, low + Vec3::Constant(step)));
            }
    return blocks;
}

struct Sums {
    double inside = 0, all = 0; ///< volumes, of blocks that are not cut too
    std::size_t pieces = 0;
};

Sums cut(const std::vector<Polyhedron>& blocks, const CuttingSurface& surface, double size) {
    const SidedBlocks result = cut_by_surface(blocks, surface, 3, 1e-6 * size);
    Sums sums;
    sums.pieces = result.inside.size();
    for (std::size_t i = 0; i < result.inside.size(); ++i) {
        const Polyhedron& piece = result.blocks.pieces[i].polyhedron;
        EXPECT_TRUE(closed(piece));
        const double volume = mass_properties(piece).volume;
        EXPECT_GT(volume, 0);
        sums.all += volume;
        if (result.inside[i]) sums.inside += volume;
    }
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (std::ranges::binary_search(result.blocks.parents, static_cast<int>(i))) continue;
        const double volume = mass_properties(blocks[i]).volume;
        sums.all += volume;
        if (std::ranges::find(result.swallowed, static_cast<int>(i)) != result.swallowed.end()) sums.inside += volume;
    }
    return sums;
}

std::string message(std::vector<Surface> bodies, const std::vector<Polyhedron>& blocks = {}) {
    try {
        cut_by_surface(blocks, cutting_surface(std::move(bodies), {}), 1, 0);
    } catch (const Diagnostic& mistake) { return mistake.message; }
    return "";
}

} // namespace

TEST(CutSurface, BodiesKeepTheirVolumeInEachFrame) {
    const Surface ball = dented_ball(1);
    for (const int n : {1, 2, 5})
        for (const Frame& frame : frames()) {
            std::vector<Polyhedron> blocks;
            for (const Polyhedron& block : bricks(1.3, n)) blocks.push_back(frame(block));
            const double unit = std::pow(frame.scale, 3), far = frame.move.norm() / frame.scale;
            const Sums sums = cut(blocks, cutting_surface({frame(ball)}, {}), 4 * frame.scale);
            const double exact = 1e-9 + 1e-14 * far;
            EXPECT_NEAR(sums.inside / unit, volume_of(ball), exact) << n;
            EXPECT_NEAR(sums.all / unit, std::pow(2.6, 3), 1e-9 + 1e-14 * far) << n;
        }
}

TEST(CutSurface, CavitiesAndSeveralBodies) {
    Surface outer = dented_ball(1), inner = dented_ball(0.4), other = dented_ball(0.5);
    for (Vec3& v : other.vertices) v += Vec3(2, 0.3, 0.1);
    const Sums sums = cut(bricks(3, 3), cutting_surface({outer, other}, {inner}), 6);
    EXPECT_NEAR(sums.inside, volume_of(outer) + volume_of(other) - volume_of(inner), 1e-9);
}

TEST(CutSurface, OpenSurfacesMayOverhang) {
    // Below the curve, between x = -1.5 and 1.5, from z = -1.5: by the trapezoidal rule along the curve.
    double area = 0;
    const auto height = [](double x) {
        for (std::size_t i = 1; i < overhanging.size(); ++i) {
            const auto& [a, b] = overhanging[i - 1];
            const auto& [c, d] = overhanging[i];
            if (i == 1 && x < 0) return b + (x - a) / (c - a) * (d - b);
            if (i + 1 == overhanging.size() && x > 0.2) return b + (x - a) / (c - a) * (d - b);
        }
        return 0.0;
    };
    auto curve = overhanging;
    curve.front() = {-1.5, height(-1.5)};
    curve.back() = {1.5, height(1.5)};
    for (std::size_t i = 1; i < curve.size(); ++i)
        area += (curve[i][0] - curve[i - 1][0]) * ((curve[i][1] + curve[i - 1][1]) / 2 + 1.5);
    for (const int n : {1, 3})
        for (const bool backwards : {false, true}) {
            Surface surface = sheet(overhanging, -9, 9);
            if (backwards) std::ranges::reverse(surface.faces);
            const SidedBlocks result = cut_by_surface(bricks(1.5, n), cutting_surface({surface}, {}), 3, 1e-6);
            double below = 0;
            for (std::size_t i = 0; i < result.inside.size(); ++i)
                if (result.inside[i]) below += mass_properties(result.blocks.pieces[i].polyhedron).volume;
            EXPECT_TRUE(result.swallowed.empty());
            if (n == 1) { EXPECT_NEAR(below, 3 * area, 1e-9); }
            const Sums sums = cut(bricks(1.5, n), cutting_surface({surface}, {}), 3);
            EXPECT_NEAR(sums.all, 27, 1e-10);
        }
}

TEST(CutSurface, OpenSurfacesDivideAlikeInEachFrame) {
    const auto volumes = [](const Frame& frame) {
        std::vector<Polyhedron> blocks;
        for (const Polyhedron& block : bricks(1.5, 2)) blocks.push_back(frame(block));
        const auto surface = cutting_surface({frame(sheet(overhanging, -9, 9))}, {});
        const SidedBlocks result = cut_by_surface(blocks, surface, 3, 4e-6 * frame.scale);
        std::array<double, 2> sides{};
        for (std::size_t i = 0; i < result.inside.size(); ++i)
            sides[result.inside[i] ? 0 : 1] +=
                mass_properties(result.blocks.pieces[i].polyhedron).volume / std::pow(frame.scale, 3);
        std::ranges::sort(sides); // which side is the upper one depends on the frame
        return sides;
    };
    const auto wanted = volumes({});
    for (const Frame& frame : frames()) {
        const double exact = 1e-9 + 1e-14 * frame.move.norm() / frame.scale;
        const auto found = volumes(frame);
        EXPECT_NEAR(found[0], wanted[0], exact);
        EXPECT_NEAR(found[1], wanted[1], exact);
    }
}

TEST(CutSurface, FlatSurfacesCutOnce) {
    const Sums sums =
        cut(bricks(1, 1), cutting_surface({sheet({{-5, -1}, {-2, -0.4}, {1, 0.2}, {5, 1}}, -3, 3)}, {}), 2);
    EXPECT_EQ(sums.pieces, 2u);
    EXPECT_NEAR(sums.inside, 4, 1e-9);
}

TEST(CutSurface, LeavesBlocksThatItOnlyTouches) {
    const SidedBlocks result = cut_by_surface({make_brick({0, 0, 0}, {1, 1, 1}), make_brick({5, 5, 5}, {6, 6, 6})},
                                              cutting_surface({sheet({{-5, 1}, {5, 1}}, -3, 3)}, {}), 3, 1e-6);
    EXPECT_TRUE(result.blocks.pieces.empty());
    EXPECT_TRUE(result.swallowed.empty());
}

TEST(CutSurface, RefusesSurfacesWithoutTwoSides) {
    EXPECT_THAT(message({sheet({{-5, 0}, {0.2, 0}}, -3, 3)}, bricks(1, 1)),
                testing::HasSubstr("the surface ends inside of a block, at (0.2, "));
    EXPECT_THAT(message({sheet({{-5, 0}, {5, 0}}, -3, 3), sheet({{-5, 1}, {5, 1}}, -3, 3)}),
                testing::HasSubstr("2 of 2 surfaces of the file are open"));
    EXPECT_THAT(message({sheet({{-5, 0}, {5, 0}}, -3, 3), dented_ball(1)}), testing::HasSubstr("1 of 2 surfaces"));
    // A scroll: two turns.
    std::vector<std::array<double, 2>> scroll;
    for (int i = 0; i <= 40; ++i)
        scroll.push_back({(0.2 + 0.02 * i) * std::cos(0.35 * i), (0.2 + 0.02 * i) * std::sin(0.35 * i)});
    EXPECT_THAT(message({sheet(scroll, -40, 40)}, {make_brick({0.3, -0.1, -0.1}, {2, 0.1, 0.1})}),
                testing::HasSubstr("the surface winds about itself"));
}
