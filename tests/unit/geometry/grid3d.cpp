#include "geometry/grid/grid3d.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/polyhedra/random.hpp"

#include <gtest/gtest.h>

using namespace kaya;

namespace {

const std::string two_tetrahedra = "* two blocks, one rigid, one of zones\n"
                                   "TOL 1e-5\n\n"
                                   "G 1 0 0 0\nG 2, 1, 0, 0\nG 30 0 1 0\nG 4 0 0 1\nG 5 0 0 -1\n"
                                   "F 1 1 2 30\nF 2 1 2 4 * south\nF 3 2 30 4\nF 9 30 1 4\n"
                                   "Z 7 1 2 30 5\n"
                                   "B 1 3 F 1 2 3 9\nB 12 0 Z 7\n"
                                   "JS 2 1-12\n"
                                   "BGROUP \"lower part\" slot 1\n12\n"
                                   "bgroup top 1\n";

std::string message_of(const std::string& text) {
    try {
        read_grid3d(text, "a.3dgrid");
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return "accepted";
}

} // namespace

TEST(Grid3d, ReadsRigidAndZonedBlocks) {
    const Grid3d grid = read_grid3d(two_tetrahedra, "a.3dgrid");
    EXPECT_EQ(grid.tolerance, 1e-5);
    EXPECT_EQ(grid.gridpoints.size(), 5u);
    ASSERT_EQ(grid.blocks.size(), 2u);
    EXPECT_EQ(grid.blocks[0].region, 3);
    EXPECT_EQ(grid.blocks[0].group, "top");
    EXPECT_EQ(grid.blocks[1].group, "lower part");
    ASSERT_EQ(grid.joint_sets.size(), 1u);
    EXPECT_EQ(grid.joint_sets[0].blocks[0], (std::array{1, 12}));
    for (const auto& block : grid.blocks) {
        const Solid solid = solid_from_surface(surface_of(grid, block));
        ASSERT_EQ(solid.parts.size(), 1u);
        EXPECT_DOUBLE_EQ(mass_properties(solid.parts[0]).volume, 1.0 / 6);
    }
    const Polyhedron lower = solid_from_surface(surface_of(grid, grid.blocks[1])).parts[0];
    const TetMesh zones = zones_of(grid, grid.blocks[1], lower);
    EXPECT_EQ(zones.tetrahedra.size(), 1u);
    ASSERT_EQ(zones.boundary.size(), 4u);
    std::vector<int> faces;
    for (const auto& triangle : zones.boundary) faces.push_back(triangle.face);
    std::sort(faces.begin(), faces.end());
    EXPECT_EQ(faces, (std::vector{0, 1, 2, 3}));
}

TEST(Grid3d, WritesWhatItReads) {
    const Grid3d grid = read_grid3d(two_tetrahedra, "a.3dgrid");
    const std::string text = write_grid3d(grid);
    EXPECT_EQ(write_grid3d(read_grid3d(text, "b")), text);
    EXPECT_NE(text.find("BGROUP \"lower part\" 12\n"), std::string::npos);
    EXPECT_NE(text.find("JS 2 1-12\n"), std::string::npos);
}

TEST(Grid3d, CutBlocksGoOutAndComeBackBitForBit) {
    const Cut parts = cut(make_brick({0, 0, 0}, {1, 1, 1}), {normal_from_dip(33, 71), {0.5, 0.5, 0.4}}, 6);
    const Grid3d out = grid_of({{1, 0, "rock", &parts.below}, {2, 5, "", &parts.above}});
    EXPECT_EQ(out.faces.size(), parts.below.faces.size() + parts.above.faces.size() - 1);
    const Grid3d back = read_grid3d(write_grid3d(out), "b");
    for (std::size_t i = 0; i < 2; ++i) {
        const Polyhedron& given = i ? parts.above : parts.below;
        const Solid solid = solid_from_surface(surface_of(back, back.blocks[i]));
        ASSERT_EQ(solid.parts.size(), 1u);
        EXPECT_EQ(mass_properties(solid.parts[0]).volume, mass_properties(given).volume);
        EXPECT_EQ(solid.parts[0].faces.back().joint_set, 6);
        for (const Vec3& v : solid.parts[0].vertices)
            EXPECT_NE(std::find(given.vertices.begin(), given.vertices.end(), v), given.vertices.end());
    }
}

TEST(Grid3d, SaysWhichLineIsWrong) {
    EXPECT_EQ(message_of("G 1 0 0\n"), "a.3dgrid, line 1: a coordinate is missing");
    EXPECT_EQ(message_of("G 1 0 0 0\nG 1 1 1 1\n"), "a.3dgrid, line 2: gridpoint 1 is defined twice");
    EXPECT_EQ(message_of("G 0 0 0 0\n"), "a.3dgrid, line 1: gridpoint is 0, and must be above 0");
    EXPECT_EQ(message_of("G 1 0 0 0\nF 1 1 2 3\n"), "a.3dgrid, line 2: gridpoint 2 has not been defined above");
    EXPECT_EQ(message_of("G 1 0 0 0\nZ 1 1 1 1\n"), "a.3dgrid, line 2: zone 1 has 3 gridpoints");
    EXPECT_EQ(message_of("Q 1\n"), "a.3dgrid, line 1: a line cannot begin with 'Q'");
    EXPECT_EQ(message_of("G 1 0 0 0 0\n"), "a.3dgrid, line 1: '0' is one word too many");
    EXPECT_EQ(message_of("* nothing\n"), "a.3dgrid holds no blocks");
    EXPECT_EQ(message_of("B 1 0 X 1\n"),
              "a.3dgrid, line 1: after the region of a block stands F with face numbers or Z with zone numbers");
    EXPECT_EQ(message_of("B 1 0 F\n"), "a.3dgrid, line 1: block 1 has neither faces nor zones");
    EXPECT_EQ(message_of(two_tetrahedra + "JS 1 1+12\n"), "a.3dgrid, line 20: '1+12' is not a pair of blocks like 3-7");
    EXPECT_EQ(message_of(two_tetrahedra + "JS 1 1-13\n"), "a.3dgrid, line 20: block 13 has not been defined above");
}

TEST(Grid3d, DamagedTextEndsInAMessageNeverInACrash) {
    Random random(5);
    int refused = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        std::string damaged = two_tetrahedra;
        for (int i = 0; i < 2; ++i)
            damaged[static_cast<std::size_t>(random.uniform() * static_cast<double>(damaged.size()))] =
                static_cast<char>(random.bits() & 255);
        try {
            const Grid3d grid = read_grid3d(damaged, "a");
            for (const auto& block : grid.blocks) {
                const Solid solid = solid_from_surface(surface_of(grid, block));
                if (!block.zones.empty()) zones_of(grid, block, solid.parts[0]);
            }
        } catch (const Diagnostic&) { ++refused; }
    }
    EXPECT_GT(refused, 300);
}
