#include "geometry/surface/joint_set.hpp"

#include "base/diagnostic.hpp"
#include "closed.hpp"

#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace kaya;

namespace {

std::string message_of(const JointSet& set) {
    try {
        joint_planes(set);
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return {};
}

/// Cuts in place: pieces replace their parents.
void cut_in_place(std::vector<Polyhedron>& blocks, const JointSet& set) {
    CutBlocks result = cut_blocks(blocks, set);
    std::vector<Polyhedron> next;
    std::size_t parent = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (parent < result.parents.size() && result.parents[parent] == static_cast<int>(i)) ++parent;
        else next.push_back(std::move(blocks[i]));
    }
    for (auto& piece : result.pieces) next.push_back(std::move(piece.polyhedron));
    blocks = std::move(next);
}

} // namespace

TEST(JointSet, BareSetIsOneHorizontalPlaneThroughTheOrigin) {
    const auto planes = joint_planes({});
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_EQ(planes[0].normal, Vec3(0, 0, 1));
    EXPECT_EQ(planes[0].origin, Vec3(0, 0, 0));
}

TEST(JointSet, IsSymmetricAboutTheOrigin) {
    JointSet set;
    set.dip = 90;
    set.dip_direction = 90;
    set.spacing = 0.5;
    set.number = 5;
    set.origin = {10, 0, 0};
    std::vector<double> places;
    for (const auto& plane : joint_planes(set)) {
        EXPECT_EQ(plane.normal, Vec3(1, 0, 0));
        places.push_back(plane.origin.x());
    }
    EXPECT_THAT(places, ::testing::ElementsAre(10, 10.5, 9.5, 11, 9));
}

TEST(JointSet, ScattersTheSameWayEveryTimeAndWithinTheDeviations) {
    JointSet set;
    set.dip = 60;
    set.dip_deviation = 5;
    set.dip_direction = 120;
    set.dip_direction_deviation = 10;
    set.spacing = 2;
    set.spacing_deviation = 0.3;
    set.number = 200;
    const auto planes = joint_planes(set);
    const auto again = joint_planes(set);
    const Vec3 mean = normal_from_dip(60, 120);
    EXPECT_EQ(planes[0].origin, set.origin);
    double widest = 0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        EXPECT_EQ(planes[i].normal, again[i].normal);
        EXPECT_EQ(planes[i].origin, again[i].origin);
        const double dip = std::acos(planes[i].normal.z()) * 180 / 3.14159265358979;
        EXPECT_NEAR(dip, 60, 5);
        widest = std::max(widest, std::abs(dip - 60));
        const double step = i % 2 ? (i + 1) / 2 : -static_cast<double>(i / 2);
        EXPECT_NEAR(mean.dot(planes[i].origin), 2 * step, 0.3 + 1e-9);
    }
    EXPECT_GT(widest, 4);
    set.seed = 1;
    EXPECT_NE(joint_planes(set)[1].normal, planes[1].normal);
}

TEST(JointSet, RefusesNumbersOutOfTheirLimits) {
    JointSet set;
    set.number = 3;
    EXPECT_EQ(message_of(set), "3 joints need a spacing, and it is 0");
    set.spacing = -1;
    EXPECT_EQ(message_of(set), "the joint set's spacing is -1, less than 0");
    set = {};
    set.number = 0;
    EXPECT_EQ(message_of(set), "the joint set's number is 0, less than 1");
    set = {};
    set.persistence = 1.5;
    EXPECT_EQ(message_of(set), "the joint set's persistence is 1.5, more than 1");
    set = {};
    set.dip = std::nan("");
    EXPECT_EQ(message_of(set), "the joint set's dip is not a finite number");
    set = {};
    set.dip_deviation = -2;
    EXPECT_EQ(message_of(set), "the joint set's dip deviation is -2, less than 0");
}

TEST(JointSet, CutsBlocksAndNamesTheirParents) {
    const std::vector<Polyhedron> blocks{make_brick({0, 0, 5}, {1, 1, 6}), make_brick({0, 0, -1}, {1, 1, 1}),
                                         make_brick({2, 0, -1}, {3, 1, 1})};
    JointSet set;
    set.id = 4;
    const CutBlocks result = cut_blocks(blocks, set);
    EXPECT_THAT(result.parents, ::testing::ElementsAre(1, 2));
    ASSERT_EQ(result.pieces.size(), 4u);
    EXPECT_EQ(result.pieces[0].parent, 1);
    EXPECT_EQ(result.pieces[3].parent, 2);
    EXPECT_EQ(result.pieces[2].polyhedron.faces.back().joint_set, 4);
    EXPECT_EQ(result.slivers, 0);
}

TEST(JointSet, CountsTheCutsThatWouldMakeSlivers) {
    JointSet set;
    set.origin = {0, 0, 0.9999};
    const CutBlocks result = cut_blocks({make_brick({0, 0, 0}, {1, 1, 1})}, set, 0.001);
    EXPECT_EQ(result.slivers, 1);
    EXPECT_TRUE(result.pieces.empty());
}

TEST(JointSet, PersistenceLeavesAShareOfBlocksWhole) {
    std::vector<Polyhedron> blocks;
    for (int i = 0; i < 2000; ++i) blocks.push_back(make_brick({2.0 * i, 0, -1}, {2.0 * i + 1, 1, 1}));
    JointSet set;
    set.persistence = 0.3;
    const CutBlocks result = cut_blocks(blocks, set);
    EXPECT_NEAR(static_cast<double>(result.parents.size()), 600, 80);
    EXPECT_EQ(cut_blocks(blocks, set).parents, result.parents);
    // The cut of a block does not depend on later blocks.
    blocks.resize(1000);
    const auto fewer = cut_blocks(blocks, set).parents;
    EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), result.parents.begin()));
    set.persistence = 0;
    EXPECT_TRUE(cut_blocks(blocks, set).parents.empty());
}

TEST(JointSet, TenThousandBlocksOfThreeScatteredSets) {
    std::vector<Polyhedron> blocks{make_brick({0, 0, 0}, {40, 40, 40})};
    const auto start = std::chrono::steady_clock::now();
    for (const auto& [dip, direction, id] : {std::tuple{12., 80., 1}, {70., 170., 2}, {75., 265., 3}}) {
        JointSet set;
        set.dip = dip;
        set.dip_deviation = 4;
        set.dip_direction = direction;
        set.dip_direction_deviation = 4;
        set.spacing = 1.8;
        set.number = 61;
        set.origin = {20, 20, 20};
        set.id = id;
        cut_in_place(blocks, set);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    double volume = 0;
    for (const auto& block : blocks) {
        ASSERT_TRUE(kaya::test::closed(block));
        ASSERT_LT(kaya::test::worst_bulge(block), 1e-9);
        const double part = mass_properties(block).volume;
        ASSERT_GT(part, 0);
        volume += part;
    }
    EXPECT_GT(blocks.size(), 10000u);
    EXPECT_NEAR(volume, 64000, 64000 * 1e-12);
    RecordProperty("blocks", static_cast<int>(blocks.size()));
    RecordProperty("seconds", std::to_string(seconds));
    EXPECT_LT(seconds, 20);
}
