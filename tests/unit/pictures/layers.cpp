#include "pictures/model_picture.hpp"

#include "tests/unit/model/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace kaya;
using namespace kaya::test;
using testing::ElementsAre;
using testing::FloatNear;

namespace {

Shown all_of(const Model& model) {
    Shown shown;
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block) shown.blocks.push_back(block);
    return shown;
}

} // namespace

// A direction with the plunge p is at sqrt(1 - sin p) from the centre: equal areas.
TEST(JointNet, DirectionsLieWhereSchmidtPutsThem) {
    constexpr double degree = std::numbers::pi / 180;
    for (const double plunge : {0.0, 10.0, 30.0, 60.0, 90.0})
        for (const double trend : {0.0, 45.0, 200.0}) {
            const Vec3 down(std::cos(plunge * degree) * std::sin(trend * degree),
                            std::cos(plunge * degree) * std::cos(trend * degree), -std::sin(plunge * degree));
            for (const double sign : {1.0, -3.0}) {
                const auto [x, y] = on_net(sign * down);
                const double radius = std::sqrt(1 - std::sin(plunge * degree));
                if (plunge == 0 && sign < 0) continue; // horizontal: both ends are drawn
                EXPECT_NEAR(x, radius * std::sin(trend * degree), 1e-9);
                EXPECT_NEAR(y, radius * std::cos(trend * degree), 1e-9);
            }
        }
}

TEST(JointNet, JointsOfBlocksThatAreNotShownAreLeftOut) {
    const Model model = hand_made_model();
    const Chart all = joint_net(model, all_of(model), false);
    ASSERT_EQ(all.curves.size(), 1U);
    EXPECT_THAT(all.curves[0].x, ElementsAre(0));
    EXPECT_THAT(joint_net(model, Shown{{0}, 0, {}}, false).curves, testing::IsEmpty());
}

// The zone of the model is a tetrahedron with corners at 0 and 1.
TEST(IsoSurfaces, LieWhereTheFieldHasTheValue) {
    const Model model = hand_made_model();
    Scene scene;
    const ColourField height{ObjectKind::gridpoint, "z",
                             [](const Model& m, Row g) -> FieldValue { return m.gridpoints.position[g].z(); }};
    add_iso_surfaces(scene, model, all_of(model), height, {0.25, 7});
    ASSERT_EQ(scene.layers.size(), 1U);
    const auto& points = scene.layers[0].points;
    ASSERT_EQ(points.size(), 9U); // one triangle
    for (std::size_t k = 2; k < 9; k += 3) EXPECT_FLOAT_EQ(points[k], 0.25F);
    EXPECT_THAT(scene.layers[0].values, testing::Each(FloatNear(0.25F, 1e-6F)));
}

TEST(Crosses, AreAsLongAsStressesAreLarge) {
    Model model = hand_made_model();
    model.zones.stress[0] << -1, -2, -4, 0, 0, 0;
    Scene scene;
    add_crosses(scene, model, all_of(model), 0.5);
    ASSERT_EQ(scene.layers.size(), 1U);
    const auto& layer = scene.layers[0];
    ASSERT_EQ(layer.points.size(), 18U); // three lines
    std::vector<double> lengths;
    for (std::size_t line = 0; line < 3; ++line) {
        double squares = 0;
        for (std::size_t k = 0; k < 3; ++k)
            squares += std::pow(static_cast<double>(layer.points[6 * line + 3 + k] - layer.points[6 * line + k]), 2);
        lengths.push_back(std::sqrt(squares));
    }
    EXPECT_THAT(lengths, ElementsAre(testing::DoubleNear(2, 1e-6), testing::DoubleNear(1, 1e-6),
                                     testing::DoubleNear(0.5, 1e-6)));
    EXPECT_EQ(scene.bars.at(0).low, -4);
}

// The contact of the model is in the plane z = 0: seen from the side it is a line, from above it is not.
TEST(Joints, SeenEdgeOnAreThickLines) {
    const Model model = hand_made_model();
    const ColourField slip{ObjectKind::sub_contact, "slip", [](const Model&, Row) -> FieldValue { return 1.0; }};
    const auto layers_from = [&](double dip) {
        Scene scene;
        scene.dip = dip, scene.dip_direction = 180;
        add_joints(scene, model, all_of(model), slip);
        return scene.layers;
    };
    const auto side = layers_from(90), above = layers_from(0);
    ASSERT_EQ(side.size(), 2U);
    EXPECT_EQ(side[1].kind, Layer::Kind::lines);
    EXPECT_GT(side[1].width, 1);
    EXPECT_EQ(side[1].bar, side[0].bar);
    EXPECT_EQ(side[1].values.size(), side[1].points.size() / 3);
    ASSERT_EQ(above.size(), 1U);
    EXPECT_EQ(above[0].points, side[0].points);
}
