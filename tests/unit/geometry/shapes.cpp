#include "geometry/surface/shapes.hpp"

#include "base/diagnostic.hpp"
#include "closed.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numbers>

using namespace kaya;
using kaya::test::closed;
using kaya::test::worst_bulge;

namespace {

template <class Make> std::string message_of(Make&& make) {
    try {
        make();
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return "accepted";
}

double volume_of(const std::vector<Polyhedron>& parts) {
    double volume = 0;
    for (const auto& part : parts) {
        EXPECT_TRUE(closed(part));
        EXPECT_LT(worst_bulge(part), 1e-9);
        volume += mass_properties(part).volume;
    }
    return volume;
}

} // namespace

TEST(Shapes, PrismOverATriangle) {
    const Solid prism = make_prism({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 3}, {1, 0, 3}, {0, 1, 3}});
    ASSERT_EQ(prism.parts.size(), 1u);
    EXPECT_EQ(prism.parts[0].faces.size(), 5u);
    EXPECT_DOUBLE_EQ(volume_of(prism.parts), 1.5);
    // The polygons may be in either order and orientation.
    EXPECT_DOUBLE_EQ(volume_of(make_prism({{0, 0, 3}, {0, 1, 3}, {1, 0, 3}}, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}).parts),
                     1.5);
}

TEST(Shapes, PrismMayBeAWedge) {
    const Solid wedge =
        make_prism({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 0, 0}, {1, 1, 0}, {1, 1, 1}, {0, 0, 1}});
    ASSERT_EQ(wedge.parts.size(), 1u);
    EXPECT_DOUBLE_EQ(volume_of(wedge.parts), 0.5);
}

TEST(Shapes, WarpedSidesBecomeTrianglesThatNeighboursShare) {
    // The roof is rotated relative to the floor; a warp of 0.2 as in real decks.
    const std::vector<Vec3> floor{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    const std::vector<Vec3> roof{{0.2, 0, 4}, {4.2, 0, 4}, {4, 4, 4}, {0, 4, 4}};
    const Solid left = make_prism(floor, roof);
    const std::vector<Vec3> floor2{{4, 0, 0}, {8, 0, 0}, {8, 4, 0}, {4, 4, 0}};
    const std::vector<Vec3> roof2{{4.2, 0, 4}, {8, 0, 4}, {8, 4, 4}, {4, 4, 4}};
    const Solid right = make_prism(floor2, roof2);
    // The slab of 8 x 4 x 4 without the corner at its west side, which is 0.2*4*4/6 or twice that, depending on the diagonal. For either
    // diagonal in the side between, the two must fill the rest exactly.
    const double missing = 128 - volume_of(left.parts) - volume_of(right.parts);
    EXPECT_TRUE(std::abs(missing - 0.2 * 16 / 6) < 1e-12 || std::abs(missing - 0.2 * 16 / 3) < 1e-12) << missing;
    EXPECT_GT(left.parts.size() + right.parts.size(), 2u); // one of them is concave along that diagonal
}

TEST(Shapes, PrismRefusesPolygonsThatDoNotMatch) {
    EXPECT_EQ(message_of([] {
                  make_prism({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {1, 0, 1}});
              }),
              "the prism's first polygon has 3 corners and the second 2");
    EXPECT_EQ(message_of([] {
                  make_prism({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 1}});
              }),
              "the prism's polygons have 2 corners");
    EXPECT_EQ(
        message_of([] {
            make_prism({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.4}, {0, 1, 0}}, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}});
        }),
        "the prism's first polygon is not flat: its corners lie up to 0.0962 off its mean plane");
}

TEST(Shapes, PrismWithATwistIsRefused) {
    // The second polygon continues from the opposite corner: the sides cross in the middle.
    const std::string message = message_of([] {
        make_prism({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{1, 1, 1}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}});
    });
    EXPECT_NE(message, "accepted");
    EXPECT_NE(message.find("prism's"), std::string::npos) << message;
}

TEST(Shapes, Tetrahedra) {
    const Polyhedron right = make_tetrahedron({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
    EXPECT_NEAR(volume_of({right}), 1.0 / 6, 1e-16);
    EXPECT_EQ(message_of([] {
                  make_tetrahedron({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)});
              }),
              "the four corners of the tetrahedron lie in one plane");
}

TEST(Shapes, Drums) {
    Drum drum{{0, 0, 0}, {3, 4, 0}, 2, 1, 12};
    const double sector = 6 * std::sin(std::numbers::pi / 6); // area of the 12-gon of radius 1
    EXPECT_NEAR(volume_of({make_drum(drum)}), sector * 5 * (4 + 2 + 1) / 3, 1e-11);
    EXPECT_EQ(make_drum(drum).faces.size(), 14u);
    drum.radius2 = 0;
    const Polyhedron cone = make_drum(drum);
    EXPECT_EQ(cone.vertices.size(), 13u);
    EXPECT_NEAR(volume_of({cone}), sector * 4 * 5 / 3, 1e-11);
    drum.sides = 2;
    EXPECT_EQ(message_of([&] { make_drum(drum); }), "the number of sides of the drum is 2, less than 3");
    EXPECT_EQ(message_of([] {
                  make_drum({{1, 1, 1}, {1, 1, 1}, 1, 1, 8});
              }),
              "the length of the drum is 0, and must be above 0");
    EXPECT_EQ(message_of([] {
                  make_drum({{0, 0, 0}, {0, 0, 1}, 0, 0, 8});
              }),
              "the larger radius of the drum is 0, and must be above 0");
}

TEST(Shapes, Cubes) {
    EXPECT_DOUBLE_EQ(volume_of({make_cube({1, 2, 3}, 2)}), 8);
    EXPECT_EQ(message_of([] { make_cube({0, 0, 0}, 0); }), "the cube's edge is 0, and must be above 0");
}

TEST(Shapes, TunnelFillsTheSquareAroundTheHole) {
    TunnelBlocks tunnel;
    tunnel.radius = 2;
    tunnel.dip = 20;
    tunnel.dip_direction = 130;
    tunnel.origin = {5, 6, 7};
    tunnel.radial = 3;
    tunnel.tangential = 2;
    tunnel.axial = 2;
    tunnel.ratio = 1.5;
    const auto blocks = make_tunnel(tunnel);
    EXPECT_EQ(blocks.size(), 3u * 16 * 2);
    const double hole = 0.5 * 16 * 4 * std::sin(2 * std::numbers::pi / 16);
    EXPECT_NEAR(volume_of(blocks), 20 * (20 * 20 - hole), 1e-9);
    const auto core = make_tunnel_core(tunnel);
    EXPECT_EQ(core.size(), 2u);
    EXPECT_NEAR(volume_of(core), 20 * hole, 1e-9);
    tunnel.axial = 0;
    EXPECT_EQ(message_of([&] { make_tunnel(tunnel); }), "the number of blocks along the axis is 0, less than 1");
}
