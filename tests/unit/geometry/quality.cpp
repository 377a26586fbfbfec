#include "geometry/polyhedra/quality.hpp"

#include "geometry/polyhedra/cut.hpp"
#include "geometry/surface/shapes.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

using namespace kaya;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

namespace {

std::vector<Ailment> ailments(const Polyhedron& p, double mean_volume = 1) {
    return ailments_of(block_quality(p), mean_volume);
}

/// Coordinates rounded as in files.
Polyhedron rounded(Polyhedron block, double digits) {
    const double unit = std::pow(10, -digits);
    for (Vec3& v : block.vertices) v = (v / unit).array().round() * unit;
    return block;
}

} // namespace

TEST(BlockQuality, NumbersOfABrick) {
    const BlockQuality q = block_quality(make_brick({0, 0, 0}, {1, 2, 2}));
    EXPECT_DOUBLE_EQ(q.volume, 4);
    EXPECT_DOUBLE_EQ(q.extent, 3);
    EXPECT_DOUBLE_EQ(q.thickness, 1);
    EXPECT_DOUBLE_EQ(q.shortest_edge, 1);
    EXPECT_DOUBLE_EQ(q.smallest_face, 2);
    EXPECT_EQ(q.open_edges, 0);
    EXPECT_EQ(q.worst_warp, 0);
    EXPECT_EQ(q.worst_bulge, 0);
}

TEST(BlockQuality, HealthyBlocksHaveNothing) {
    EXPECT_THAT(ailments(make_brick({0, 0, 0}, {1, 1, 1})), IsEmpty());
    EXPECT_THAT(ailments(make_drum({{0, 0, 0}, {0, 0, 1}, 1, 1, 8})), IsEmpty());
}

TEST(BlockQuality, FindsEachAilment) {
    EXPECT_THAT(ailments(make_brick({0, 0, 0}, {1, 1, 0.01})), ElementsAre(Ailment::thin));
    EXPECT_THAT(ailments(make_brick({0, 0, 0}, {1, 0.02, 0.02})), ElementsAre(Ailment::needle));
    EXPECT_THAT(ailments(make_brick({0, 0, 0}, {0.01, 0.01, 0.01})), ElementsAre(Ailment::tiny));

    Polyhedron inverted = make_brick({0, 0, 0}, {1, 1, 1});
    for (auto& face : inverted.faces) std::reverse(face.vertices.begin(), face.vertices.end());
    EXPECT_THAT(ailments(inverted), ElementsAre(Ailment::inverted));

    Polyhedron open = make_brick({0, 0, 0}, {1, 1, 1});
    open.faces.pop_back();
    EXPECT_EQ(block_quality(open).open_edges, 4);
    EXPECT_EQ(ailments(open).front(), Ailment::open);

    Polyhedron warped = make_brick({0, 0, 0}, {1, 1, 1});
    warped.vertices[7] *= 0.9;
    EXPECT_THAT(ailments(warped), ::testing::Contains(Ailment::warped));

    Polyhedron dented = make_tetrahedron({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
    const auto base = dented.faces.front().vertices;
    dented.vertices.push_back(Vec3(0.25, 0.25, 0.1)); // a dent in the lowest face
    dented.faces.erase(dented.faces.begin());
    for (int i = 0; i < 3; ++i) dented.faces.push_back({{base[i], base[(i + 1) % 3], 4}, 0});
    EXPECT_EQ(block_quality(dented).open_edges, 0);
    EXPECT_THAT(ailments(dented), ElementsAre(Ailment::concave));

    const Polyhedron chipped =
        cut(make_brick({0, 0, 0}, {1, 1, 1}), {Vec3(1, 1, 1).normalized(), {1, 1, 0.9995}}, 1).below;
    EXPECT_THAT(ailments(chipped), ElementsAre(Ailment::short_edge));
}

TEST(BlockQuality, EveryAilmentHasANameAndARemedy) {
    for (const Ailment a : {Ailment::open, Ailment::inverted, Ailment::concave, Ailment::warped, Ailment::tiny,
                            Ailment::needle, Ailment::thin, Ailment::short_edge}) {
        EXPECT_FALSE(name_of(a).empty());
        EXPECT_GT(remedy_for(a).size(), 20u);
    }
    EXPECT_EQ(name_of(Ailment::needle), "needle");
}

TEST(OverlappingBlocks, FindsEqualAndPartlyCommonBlocksAndNotTouchingOnes) {
    const std::vector<Polyhedron> blocks{make_brick({0, 0, 0}, {1, 1, 1}), make_brick({1, 0, 0}, {2, 1, 1}),
                                         make_brick({0, 0, 0}, {1, 1, 1}), make_brick({1.75, 0.5, 0}, {2.75, 1.5, 1}),
                                         make_drum({{5, 0, 0}, {5, 0, 1}, 1, 1, 8})};
    const auto found = overlapping_blocks(blocks);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].first, 0);
    EXPECT_EQ(found[0].second, 2);
    EXPECT_DOUBLE_EQ(found[0].share, 1);
    EXPECT_EQ(found[1].first, 1);
    EXPECT_EQ(found[1].second, 3);
    EXPECT_NEAR(found[1].share, 0.125, 1e-14);
}

TEST(OverlappingBlocks, BlocksThatOnlyTouchDoNotOverlapWhateverTheirDigits) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(-1, 1);
    int pairs = 0;
    for (int i = 0; i < 200; ++i) {
        Polyhedron block = make_brick({0, 0, 0}, {1, 1, 1});
        for (int k = 0; k < 6; ++k) { // a cell with faces in any direction
            const Vec3 normal = Vec3(part(random), part(random), part(random)).normalized();
            const Cut chip = cut(block, {normal, Vec3(0.5, 0.5, 0.5) + 0.4 * normal}, 0);
            if (chip.outcome == CutOutcome::cut) block = chip.below;
        }
        const Vec3 normal = Vec3(part(random), part(random), part(random)).normalized();
        const Cut halves = cut(block, {normal, {0.5, 0.5, 0.5}}, 0);
        if (halves.outcome != CutOutcome::cut) continue;
        for (const double digits : {7.0, 9.0, 12.0}) {
            const Polyhedron one = rounded(halves.below, digits), other = rounded(halves.above, digits);
            EXPECT_TRUE(overlapping_blocks({one, other}).empty()) << i << ", " << digits << " digits";
            ++pairs;
        }
        Polyhedron pushed = halves.above;
        for (Vec3& v : pushed.vertices) v -= 0.1 * normal;
        const auto found = overlapping_blocks({halves.below, pushed});
        ASSERT_EQ(found.size(), 1u) << i;
        EXPECT_GT(found[0].share, 0.05);
        EXPECT_LE(found[0].share, 0.5);
    }
    EXPECT_GT(pairs, 400);
}
