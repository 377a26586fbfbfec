// Ground surfaces: heights, files, and cut blocks.
#include "geometry/ground/ground.hpp"
#include "geometry/ground/ground_cuts.hpp"

#include "base/diagnostic.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace kaya {
namespace {

using testing::HasSubstr;

/// z = f(x, y) on a grid of n by n points over a square of the side `size` about 0.
template <class Height> Ground grid(std::size_t n, double size, Height height) {
    std::vector<Vec3> corners;
    std::vector<std::array<int, 3>> triangles;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k) {
            const double x = size * (static_cast<double>(i) / static_cast<double>(n - 1) - 0.5),
                         y = size * (static_cast<double>(k) / static_cast<double>(n - 1) - 0.5);
            corners.emplace_back(x, y, height(x, y));
        }
    for (std::size_t i = 0; i + 1 < n; ++i)
        for (std::size_t k = 0; k + 1 < n; ++k) {
            const auto id = [&](std::size_t a, std::size_t b) { return static_cast<int>(a * n + b); };
            triangles.push_back({id(i, k), id(i + 1, k), id(i + 1, k + 1)});
            triangles.push_back({id(i, k), id(i + 1, k + 1), id(i, k + 1)});
        }
    return {corners, triangles};
}

struct Volumes {
    double below = 0, above = 0;
    std::size_t pieces = 0;
};

/// Cuts a brick and checks that its pieces fill it, are valid, and are on their side of the surface.
Volumes cut_brick(const Ground& ground, const Vec3& low, const Vec3& high) {
    const Polyhedron brick = make_brick(low, high);
    const SidedBlocks cut = cut_by_ground({brick}, ground, 3, 1e-6 * (high - low).norm());
    Volumes volumes;
    volumes.pieces = cut.blocks.pieces.size();
    for (std::size_t i = 0; i < cut.blocks.pieces.size(); ++i) {
        const Polyhedron& piece = cut.blocks.pieces[i].polyhedron;
        const auto mass = mass_properties(piece);
        EXPECT_GT(mass.volume, 0);
        (cut.inside[i] ? volumes.below : volumes.above) += mass.volume;
        const double height = ground.height_beyond(mass.centroid.x(), mass.centroid.y());
        EXPECT_EQ(cut.inside[i], mass.centroid.z() < height) << "piece " << i << " at " << mass.centroid.transpose();
        // No corner is on the other side.
        for (const Vec3& v : piece.vertices) {
            const double over = v.z() - ground.height_beyond(v.x(), v.y());
            EXPECT_GE(cut.inside[i] ? -over : over, -1e-5 * (high - low).norm())
                << "piece " << i << " corner " << v.transpose();
        }
    }
    const double whole = mass_properties(brick).volume;
    EXPECT_NEAR(volumes.above + volumes.below, volumes.pieces > 0 ? whole : 0, 1e-9 * whole);
    return volumes;
}

/// Volume below the surface over the plan of a brick, by sampling.
double volume_below(const Ground& ground, const Vec3& low, const Vec3& high, int n = 400) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double x = low.x() + (high.x() - low.x()) * (i + 0.5) / n,
                         y = low.y() + (high.y() - low.y()) * (k + 0.5) / n;
            sum += std::clamp(ground.height_beyond(x, y), low.z(), high.z()) - low.z();
        }
    return sum * (high.x() - low.x()) * (high.y() - low.y()) / (n * n);
}

} // namespace

TEST(Ground, HeightsAreLinearInTrianglesAndGoOnBeyondTheRim) {
    const Ground ground({{0, 0, 1}, {2, 0, 3}, {0, 2, 5}}, {{0, 1, 2}});
    EXPECT_DOUBLE_EQ(*ground.height(0.5, 0.5), 1 + 0.5 + 1);
    EXPECT_FALSE(ground.height(2, 2));
    EXPECT_DOUBLE_EQ(ground.height_beyond(-1, -1), 1);
    EXPECT_DOUBLE_EQ(ground.height_beyond(2, 2), 4);
}

TEST(Ground, OfOverhangsTheHighestCounts) {
    const Ground ground({{0, 0, 1}, {2, 0, 1}, {0, 2, 1}, {0, 0, 4}, {2, 0, 4}, {0, 2, 4}},
                        {{0, 1, 2}, {3, 4, 5}, {0, 1, 4}});
    EXPECT_EQ(ground.triangles().size(), 2u); // the vertical one is ignored
    EXPECT_DOUBLE_EQ(*ground.height(0.5, 0.5), 4);
}

TEST(Ground, ContourLinesStayEdges) {
    // Two long lines at the heights 0 and 10, sampled unevenly: no triangle may cross one.
    std::vector<std::vector<Vec3>> lines(3);
    for (int i = 0; i <= 10; ++i) lines[0].emplace_back(i, 0, 0);
    for (int i = 0; i <= 2; ++i) lines[1].emplace_back(5 * i, 0.3, 10);
    for (int i = 0; i <= 10; ++i) lines[2].emplace_back(i, 5, 10);
    const Ground ground = Ground::of_points(lines);
    EXPECT_NEAR(*ground.height(2.5, 0.3), 10, 1e-12);
    EXPECT_NEAR(*ground.height(7.3, 0), 0, 1e-12);
}

TEST(Ground, CutsABrickAtAFlatSlopeAsASingleJointWould) {
    const Ground ground = grid(7, 20, [](double x, double) { return 0.3 * x; });
    const auto volumes = cut_brick(ground, {-5, -5, -5}, {5, 5, 5});
    EXPECT_EQ(volumes.pieces, 2u);
    EXPECT_NEAR(volumes.below, 500, 1e-6);
}

TEST(Ground, AnOpenCutNeedsFewPieces) {
    // Floor, slope and top: a profile along x. Deep rock is not cut.
    std::vector<std::vector<Vec3>> lines;
    for (const double x : {-50.0, 0.0, 20.0, 60.0})
        lines.push_back({{x, -50, x <= 0 ? 0.0 : 10}, {x, 50, x <= 0 ? 0.0 : 10}});
    const auto volumes = cut_brick(Ground::of_points(lines), {-30, -10, -40}, {50, 10, 25});
    EXPECT_LE(volumes.pieces, 8u);
    EXPECT_NEAR(volumes.below, 20 * (80 * 40 + 0.5 * 20 * 10 + 30 * 10), 1e-6);
}

TEST(Ground, RandomHillsFillTheirBlocks) {
    std::mt19937_64 random(3);
    const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    for (int k = 0; k < 25; ++k) {
        SCOPED_TRACE(k);
        const double a = any(0, 4), b = any(0.05, 0.6), c = any(0, 6), d = any(-0.4, 0.4),
                     unit = std::pow(10, any(-2, 3));
        const Ground ground = grid(3 + random() % 9, 24 * unit, [&](double x, double y) {
            return unit * (a * std::sin(b * x / unit + c) + 2 * std::cos(b * y / unit) + d * x / unit);
        });
        const Vec3 low = unit * Vec3(any(-9, -1), any(-9, -1), any(-9, -2)),
                   high = unit * Vec3(any(1, 9), any(1, 9), any(1, 9));
        const auto volumes = cut_brick(ground, low, high);
        if (volumes.pieces == 0) continue;
        const double box = (high - low).prod();
        EXPECT_NEAR(volumes.below, volume_below(ground, low, high), 2e-4 * box);
    }
}

TEST(Ground, NeighboursOfAPitOfBenchesFit) {
    // Rings of a round pit with benches, cut out of four bricks that share their faces.
    std::vector<std::vector<Vec3>> rings;
    double radius = 10, z = 0;
    for (int bench = 0; bench < 4; ++bench)
        for (int top = 0; top < 2; ++top) {
            auto& ring = rings.emplace_back();
            for (int i = 0; i <= 16; ++i) {
                const double angle = 2 * std::numbers::pi * (i % 16) / 16 + 0.1;
                ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
            }
            radius += top == 0 ? 3 : 4;
            if (top == 0) z += 8;
        }
    rings.push_back({{-60, -60, z}, {60, -60, z}, {60, 60, z}, {-60, 60, z}, {-60, -60, z}});
    const Ground ground = Ground::of_points(rings);
    for (const int sx : {-1, 1})
        for (const int sy : {-1, 1}) {
            const Vec3 low(sx < 0 ? -50 : 0, sy < 0 ? -50 : 0, -20), high(sx < 0 ? 0 : 50, sy < 0 ? 0 : 50, 40);
            const auto volumes = cut_brick(ground, low, high);
            EXPECT_LT(volumes.pieces, 400u);
            EXPECT_NEAR(volumes.below, volume_below(ground, low, high), 1e-3 * (high - low).prod());
        }
}

TEST(Ground, FilesAreReadOrRefusedWithTheirLine) {
    EXPECT_EQ(ground_from_points("x,y,z\n0,0,1\n1,0,1\n0,1,2\n", "a.csv").triangles().size(), 1u);
    const Ground grid = ground_from_grid(
        "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n5 6 -9999\n1 2 3\n", "a.asc");
    EXPECT_EQ(grid.triangles().size(), 2u);
    EXPECT_DOUBLE_EQ(*grid.height(5, 5), 1);
    EXPECT_DOUBLE_EQ(*grid.height(5, 15), 5);
    const auto refusal = [](auto read) -> std::string {
        try {
            read();
        } catch (const Diagnostic& wrong) { return wrong.message; }
        return "read";
    };
    EXPECT_THAT(refusal([] { ground_from_points("0 0 1\n1 0\n", "a.xyz"); }),
                HasSubstr("a.xyz:2: a point of a surface is three numbers"));
    EXPECT_THAT(refusal([] { ground_from_points("0 0 1\n1 0 nan\n", "a.xyz"); }), HasSubstr("a.xyz:2"));
    EXPECT_THAT(refusal([] { ground_from_points("", "a.xyz"); }), HasSubstr("0 points"));
    EXPECT_THAT(refusal([] { ground_from_points("0 0 1\n1 1 1\n2 2 1\n", "a.xyz"); }), HasSubstr("on one line"));
    EXPECT_THAT(refusal([] { ground_from_points("0 0 0\n2 2 0\n\n0 2 1\n2 0 1\n", "a.xyz"); }),
                HasSubstr("cross each other"));
    EXPECT_THAT(refusal([] { ground_from_grid("ncols 2\nnrows 2\ncellsize 1\n1 2 3 4\n", "a.asc"); }),
                HasSubstr("xllcorner"));
    EXPECT_THAT(
        refusal([] { ground_from_grid("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n", "a.asc"); }),
        HasSubstr("3 heights"));
    EXPECT_THAT(
        refusal([] { ground_from_grid("ncols 2e9\nnrows 2e9\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n", "a.asc"); }),
        HasSubstr("make no grid"));
    const test::ScratchFolder folder;
    test::put(
        folder / "a.stl",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 4 0 0\nvertex 0 4 4\nendloop\nendfacet\nendsolid\n");
    EXPECT_NEAR(*read_ground(folder / "a.stl").height(1, 1), 1, 1e-6);
    EXPECT_THAT(refusal([&] { read_ground(folder / "none.xyz"); }), HasSubstr("cannot be opened"));
}

/// A roof of two triangles, z = 1 + min(x, y) over a square, in each format with surfaces.
TEST(Ground, EverySurfaceFormatIsGround) {
    const test::ScratchFolder folder;
    const std::string points = "0 0 1\n4 0 1\n4 4 5\n0 4 1\n";
    const auto corners = [](std::initializer_list<std::array<int, 3>> places) { // of a 3DFACE
        std::string text = "0\n3DFACE\n8\nA\n";
        int k = 0;
        for (const auto& [x, y, z] : places) {
            text += "1" + std::to_string(k) + "\n" + std::to_string(x) + "\n2" + std::to_string(k) + "\n" +
                    std::to_string(y) + "\n3" + std::to_string(k) + "\n" + std::to_string(z) + "\n";
            ++k;
        }
        return text;
    };
    const std::vector<std::pair<const char*, std::string>> files{
        {"a.obj", "v 0 0 1\nv 4 0 1\nv 4 4 5\nv 0 4 1\nf 1 2 3\nf 1 3 4\n"},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                  "element face 2\nproperty list uchar int vertex_indices\nend_header\n" +
                      points + "3 0 1 2\n3 0 2 3\n"},
        {"a.dxf", "0\nSECTION\n2\nENTITIES\n" + corners({{0, 0, 1}, {4, 0, 1}, {4, 4, 5}, {4, 4, 5}}) +
                      corners({{0, 0, 1}, {4, 4, 5}, {0, 4, 1}, {0, 4, 1}}) + "0\nENDSEC\n0\nEOF\n"},
        {"a.ts",
         "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 1\nVRTX 2 4 0 1\nVRTX 3 4 4 5\nVRTX 4 0 4 1\nTRGL 1 2 3\nTRGL 1 3 4\n"
         "END\n"},
        {"a.wrl", "#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 1, 4 0 1, 4 4 5, "
                  "0 4 1 ] } coordIndex [ 0 1 2 -1 0 2 3 -1 ] } }\n"},
        {"a.json", "{\"vertex\": [[0,0,1],[4,0,1],[4,4,5],[0,4,1]], \"face\": [[0,1,2],[0,2,3]]}"},
        {"a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n" + points +
                      "POLYGONS 2 8\n3 0 1 2\n3 0 2 3\n"},
    };
    for (const auto& [name, text] : files) {
        test::put(folder / name, text);
        const Ground ground = read_ground(folder / name);
        for (const auto& [x, y] : {std::pair(1., 2.), {3., 0.5}, {2., 2.}, {0., 4.}, {4., 4.}}) {
            const auto height = ground.height(x, y);
            ASSERT_TRUE(height.has_value()) << name;
            EXPECT_NEAR(*height, 1 + std::min(x, y), 1e-6) << name;
        }
    }
}

} // namespace kaya
