#include "geometry/grid/grid3d.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

using namespace kaya;

namespace {

const std::string two_tetrahedra =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n2\n2 3 \"wall\"\n3 7 \"rock mass\"\n$EndPhysicalNames\n"
    "$Entities\n0 0 1 1\n9 0 0 0 1 1 1 1 3 0\n5 0 0 0 1 1 1 1 7 1 9\n$EndEntities\n"
    "$Nodes\n1 5 1 5\n3 5 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
    "$Elements\n2 3 1 3\n2 9 2 1\n1 1 2 3\n3 5 4 2\n2 1 2 3 4\n3 2 3 4 5\n$EndElements\n"
    "$Periodic\nanything\n$EndPeriodic\n";

std::string old_file(const std::string& nodes, const std::string& elements) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + nodes + "$EndNodes\n$Elements\n" + elements +
           "$EndElements\n";
}
const std::string cube = "8\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n5 0 0 2\n6 2 0 2\n7 2 2 2\n8 0 2 2\n";

double volume_of(const Grid3d& grid) {
    double sum = 0;
    for (const auto& block : grid.blocks)
        for (const int zone : block.zones) {
            const auto& t = grid.zones.at(zone);
            const Vec3& a = grid.gridpoints.at(t[0]);
            sum += std::abs((grid.gridpoints.at(t[1]) - a)
                                .cross(grid.gridpoints.at(t[2]) - a)
                                .dot(grid.gridpoints.at(t[3]) - a)) /
                   6;
        }
    return sum;
}

std::string message_of(const std::string& text) {
    try {
        read_msh(text, "a.msh");
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return "accepted";
}

} // namespace

TEST(ReadMsh, TetrahedraOfAPhysicalGroupAreABlock) {
    const Grid3d grid = read_msh(two_tetrahedra, "a.msh");
    EXPECT_EQ(grid.gridpoints.size(), 5u);
    ASSERT_EQ(grid.blocks.size(), 1u);
    EXPECT_EQ(grid.blocks[0].group, "rock mass");
    EXPECT_EQ(grid.blocks[0].region, 7);
    EXPECT_EQ(grid.blocks[0].material, 7);
    EXPECT_EQ(grid.blocks[0].zones.size(), 2u);
    EXPECT_DOUBLE_EQ(volume_of(grid), 1.0 / 6 + 1.0 / 3);
}

TEST(ReadMsh, AHexahedronIsSixZones) {
    const Grid3d grid = read_msh(old_file(cube, "1\n1 5 2 4 1 1 2 3 4 5 6 7 8\n"), "a.msh");
    ASSERT_EQ(grid.blocks.size(), 1u);
    EXPECT_EQ(grid.blocks[0].zones.size(), 6u);
    EXPECT_EQ(grid.blocks[0].group, "physical-4");
    EXPECT_DOUBLE_EQ(volume_of(grid), 8);
}

TEST(ReadMsh, SeparatePartsAreSeparateBlocks) {
    const std::string nodes = "8\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n11 5 0 0\n12 6 0 0\n13 5 1 0\n14 5 0 1\n";
    const Grid3d grid = read_msh(old_file(nodes, "2\n1 4 2 0 1 1 2 3 4\n2 4 2 0 1 11 12 13 14\n"), "a.msh");
    EXPECT_EQ(grid.blocks.size(), 2u);
    EXPECT_EQ(grid.blocks[0].material, 0); // the command says which
}

TEST(ReadMsh, MistakesAreNamedWithTheirLine) {
    const std::string tet = "4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
    EXPECT_EQ(message_of(""), "a.msh, line 1: the file ends before '$MeshFormat'");
    EXPECT_EQ(message_of("$MeshFormat\n3 0 8\n"), "a.msh, line 2: the version is '3'; 2.2 and 4.1 are read");
    EXPECT_EQ(message_of("$MeshFormat\n4.1 1 8\n"), "a.msh, line 2: the file is binary, and is read as text only");
    EXPECT_EQ(message_of(old_file(tet, "0\n")), "a.msh, line 14: there is no element in it that fills space");
    EXPECT_EQ(message_of(old_file(tet, "1\n1 4 2 0 1 1 2 3 9\n")),
              "a.msh, line 13: element 1 has node 9, which is not there");
    EXPECT_EQ(message_of(old_file(tet, "1\n1 4 2 0 1 1 2 3\n")), "a.msh, line 13: the number of a node is missing");
    EXPECT_EQ(message_of(old_file(tet, "1\n1 4 2 0 1 1 2 3 3\n")), "a.msh, line 13: tetrahedron 1 has no volume");
    EXPECT_EQ(message_of(old_file(tet, "1\n1 11 2 0 1 1 2 3 4\n")), "a.msh, line 13: the number of a node is missing");
    EXPECT_EQ(message_of(old_file("1\n1 0 nan 0\n", "0\n")),
              "a.msh, line 6: 'nan' is not a number: expected a coordinate");
    EXPECT_EQ(message_of(old_file("2\n1 0 0 0\n1 0 0 1\n", "0\n")), "a.msh, line 7: node 1 is defined twice");
    EXPECT_EQ(message_of(old_file("-1\n", "0\n")), "a.msh, line 5: the number of nodes is -1");
    EXPECT_EQ(message_of(old_file(cube, "1\n1 5 2 4 1 1 3 2 4 5 6 7 8\n")),
              "a.msh, line 17: hexahedron 1 has no volume");
}

/// Every truncated file, and files with changed numbers, are either refused or read.
TEST(ReadMsh, BrokenFilesAreRefused) {
    for (std::size_t size = 0; size + 40 < two_tetrahedra.size(); ++size)
        EXPECT_NE(message_of(two_tetrahedra.substr(0, size)), "accepted") << size;
    std::mt19937 random(3);
    const std::string strange[] = {
        "-1", "0", "99999999999999999999", "9223372036854775807", "2147483648", "1e400", "$Nodes", "\"", "x", ""};
    for (int i = 0; i < 3000; ++i) {
        std::string text = two_tetrahedra;
        for (int k = 0; k < 2; ++k) {
            const std::size_t at = random() % text.size();
            const std::size_t from = text.find_last_of(" \n", at), to = text.find_first_of(" \n", at);
            if (from == std::string::npos || to == std::string::npos || to <= from) continue;
            text.replace(from + 1, to - from - 1, strange[random() % std::size(strange)]);
        }
        message_of(text);
    }
}
