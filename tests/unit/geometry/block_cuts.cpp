#include "geometry/surface/block_cuts.hpp"

#include "base/diagnostic.hpp"
#include "closed.hpp"
#include "geometry/surface/shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace kaya;
using kaya::test::closed;

namespace {

struct Volumes {
    double inside = 0, outside = 0;
};

Volumes volumes_of(const SidedBlocks& cut) {
    Volumes volumes;
    for (std::size_t i = 0; i < cut.inside.size(); ++i) {
        const Polyhedron& piece = cut.blocks.pieces[i].polyhedron;
        EXPECT_TRUE(closed(piece));
        (cut.inside[i] ? volumes.inside : volumes.outside) += mass_properties(piece).volume;
    }
    return volumes;
}

/// A horseshoe-shaped pentagon in the plane y.
std::vector<Vec3> horseshoe(double y) { return {{-1, y, -1}, {1, y, -1}, {1, y, 0.5}, {0, y, 1}, {-1, y, 0.5}}; }

} // namespace

TEST(CutTunnel, TakesTheOutlineOutOfOneBlock) {
    const SidedBlocks result =
        cut_tunnel({make_brick({-5, 0, -5}, {5, 4, 5})}, {{horseshoe(-1), horseshoe(5)}, false, 3});
    const Volumes volumes = volumes_of(result);
    EXPECT_NEAR(volumes.inside, 4 * 3.5, 1e-12);
    EXPECT_NEAR(volumes.inside + volumes.outside, 400, 1e-10);
    EXPECT_EQ(std::count(result.inside.begin(), result.inside.end(), true), 1);
    EXPECT_EQ(result.inside.size(), 6u);
    EXPECT_EQ(result.blocks.pieces.back().polyhedron.faces.back().joint_set, 3);
}

TEST(CutTunnel, LeavesBlocksOutsideItUncut) {
    const std::vector<Polyhedron> blocks{make_brick({5, 0, 5}, {6, 1, 6}), make_brick({-0.5, 0, -0.5}, {0.5, 1, 0}),
                                         make_brick({0, 0, 0}, {3, 1, 0.5}), make_brick({1, 0, -1}, {2, 1, 0})};
    const SidedBlocks result = cut_tunnel(blocks, {{horseshoe(-1), horseshoe(5)}});
    EXPECT_THAT(result.blocks.parents, ::testing::ElementsAre(2));
    EXPECT_THAT(result.swallowed, ::testing::ElementsAre(1));
}

TEST(CutTunnel, BlocksThatItOnlyScratchesStayOnTheSideOfTheirGreaterPart) {
    const std::vector<Polyhedron> blocks{make_brick({0.999, 0, -1}, {2, 1, 0}), make_brick({0, 0, -1}, {1.001, 1, 0})};
    const SidedBlocks result = cut_tunnel(blocks, {{horseshoe(-1), horseshoe(5)}}, 0.01);
    EXPECT_TRUE(result.blocks.parents.empty());
    EXPECT_THAT(result.swallowed, ::testing::ElementsAre(1));
    EXPECT_EQ(result.blocks.slivers, 2);
}

TEST(CutTunnel, ManyBlocksKeepTheirVolume) {
    JointSet set;
    set.dip = 50;
    set.dip_direction = 30;
    set.spacing = 1.1;
    set.number = 15;
    const CutBlocks jointed = cut_blocks({make_brick({-5, 0, -5}, {5, 4, 5})}, set);
    std::vector<Polyhedron> blocks;
    for (const auto& piece : jointed.pieces) blocks.push_back(piece.polyhedron);
    const SidedBlocks result = cut_tunnel(blocks, {{horseshoe(-1), horseshoe(5)}});
    double untouched = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i)
        if (!std::binary_search(result.blocks.parents.begin(), result.blocks.parents.end(), static_cast<int>(i)))
            untouched += mass_properties(blocks[i]).volume;
    const Volumes volumes = volumes_of(result);
    EXPECT_NEAR(volumes.inside, 14, 1e-11);
    EXPECT_NEAR(volumes.inside + volumes.outside + untouched, 400, 400 * 1e-12);
}

TEST(CutTunnel, ConcaveOutlinesAndRadialJoints) {
    const auto angle = [](double y) {
        return std::vector<Vec3>{{-1, y, -1}, {1, y, -1}, {1, y, 0}, {0, y, 0}, {0, y, 1}, {-1, y, 1}};
    };
    Volumes volumes = volumes_of(cut_tunnel({make_brick({-5, 0, -5}, {5, 4, 5})}, {{angle(-1), angle(5)}}));
    EXPECT_NEAR(volumes.inside, 12, 1e-12);
    EXPECT_NEAR(volumes.inside + volumes.outside, 400, 1e-10);

    const SidedBlocks plain = cut_tunnel({make_brick({-5, 0, -5}, {5, 4, 5})}, {{horseshoe(-1), horseshoe(5)}});
    const SidedBlocks radial =
        cut_tunnel({make_brick({-5, 0, -5}, {5, 4, 5})}, {{horseshoe(-1), horseshoe(5)}, true, 0});
    EXPECT_GT(radial.inside.size(), plain.inside.size());
    volumes = volumes_of(radial);
    EXPECT_NEAR(volumes.inside, 14, 1e-12);
    EXPECT_NEAR(volumes.inside + volumes.outside, 400, 1e-10);
}

TEST(CutTunnel, FollowsAPath) {
    const std::vector<Vec3> square{{-1, -8, -1}, {1, -8, -1}, {1, -8, 1}, {-1, -8, 1}};
    const std::vector<Vec3> path{{0, -8, 0}, {0, 0, 0}, {6, 6, 0}, {6, 9, 3}, {6, 20, 3}};
    const auto sections = sections_along(square, path);
    ASSERT_EQ(sections.size(), 5u);
    double length = 0;
    for (std::size_t k = 1; k < path.size(); ++k) length += (path[k] - path[k - 1]).norm();
    std::vector<Polyhedron> blocks;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 8; ++j)
            blocks.push_back(make_brick({-10. + 5 * i, -10. + 5 * j, -8}, {-5. + 5 * i, -5. + 5 * j, 8}));
    const SidedBlocks cut = cut_tunnel(blocks, {sections, false, 3}, 1e-6);
    const Volumes volumes = volumes_of(cut);
    EXPECT_NEAR(volumes.inside, 4 * length, 1e-9); // the axis passes through the centroid of each section
    // A block that lies in the tunnel, across a turn, stays whole.
    const SidedBlocks small = cut_tunnel({make_brick({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3})}, {sections, false, 3});
    EXPECT_TRUE(small.blocks.pieces.empty());
    EXPECT_THAT(small.swallowed, ::testing::ElementsAre(0));
    EXPECT_THROW(sections_along(square, {{0, -8, 0}}), Diagnostic);
    EXPECT_THROW(sections_along(square, {{0, -8, 0}, {0, -8, 0}}), Diagnostic);
    EXPECT_THROW(sections_along(square, {{0, -8, 0}, {0, 0, 0}, {0.5, -7, 0}}), Diagnostic); // too sharp
    EXPECT_THROW(sections_along(square, {{0, -8, 0}, {0, 0, 0}, {0, -8, 0}}), Diagnostic);   // back
}

TEST(Densify, CutsIntoEvenParts) {
    const CutBlocks result =
        densify({make_brick({0, 0, 0}, {1, 1, 1}), make_brick({2, 0, 0}, {3, 2, 2})}, {2, 3, 1}, 5);
    EXPECT_EQ(result.pieces.size(), 12u);
    EXPECT_THAT(result.parents, ::testing::ElementsAre(0, 1));
    for (const auto& piece : result.pieces)
        EXPECT_NEAR(mass_properties(piece.polyhedron).volume, piece.parent ? 4.0 / 6 : 1.0 / 6, 1e-15);
    EXPECT_TRUE(densify({make_brick({0, 0, 0}, {1, 1, 1})}, {1, 1, 1}).pieces.empty());
    EXPECT_THROW(densify({}, {1, 0, 1}), Diagnostic);
}
