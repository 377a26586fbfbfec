// Joined blocks: their common motion, and their separation.
#include "running.hpp"

#include "model/edit/joined.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gmock/gmock.h>
#include <string>

namespace kaya {
namespace {

using testing::HasSubstr;

class Joined : public Running {
protected:
    Joined() { session().engine.joints.set_path({KAYA_TEST_JOINTS}); }
    void start() {
        model().settings.given_time_step = 1e-3;
        run("prop mat 1 dens 1000\ndamp none\ngravity 0 0 -10\n");
        for (std::size_t b = 0; b < model().blocks.size(); ++b) {
            const Vec3 arm = model().blocks.centroid[b] - Vec3(1, 0.5, 0.75);
            model().blocks.rotational_velocity[b] = Vec3(0.1, 3, 0.2);
            model().blocks.velocity[b] = Vec3(1, 0, 2) + Vec3(0.1, 3, 0.2).cross(arm);
        }
    }
    Vec3 corner() {
        const auto rows = select(model(), ObjectKind::gridpoint, {});
        Vec3 found = Vec3::Zero();
        for (const Row row : rows)
            if (model().gridpoints.position[row] == Vec3(2, 1, 1.5)) corner_ = row;
        if (corner_ != no_row) found = model().gridpoints.position[corner_];
        return found;
    }
    Row corner_ = no_row;
};

TEST_F(Joined, PiecesPutTogetherSpinAsTheWholeBlockDoes) {
    run("new\npoly brick 0 2 0 1 0 1.5");
    start();
    corner();
    // The angular momentum of the body, known before its first step.
    const double mass = 3000;
    model().blocks.mass[0] = mass;
    const Vec3 momentum = mass / 3.0 * (model().blocks.inertia[0] * Vec3(0.1, 3, 0.2));
    model().blocks.angular_momentum[0] = momentum;
    run("cycle 2000");
    const Vec3 whole = corner(), spin = model().blocks.rotational_velocity[0];
    const double energy = model().energy.kinetic;

    run("new\npoly brick 0 2 0 1 0 1.5\njset dip 60 dd 90 org 1 .5 .7\njset dip 50 dd 200 org 1 .5 .7");
    ASSERT_EQ(model().blocks.size(), 4u);
    corner_ = no_row;
    start();
    corner();
    ASSERT_NE(corner_, no_row);
    for (std::size_t b = 0; b < 4; ++b) model().blocks.mass[b] = 1000 * model().blocks.volume[b];
    for (std::size_t b = 0; b < 4; ++b)
        model().blocks.angular_momentum[b] = 1000 * (model().blocks.inertia[b] * Vec3(0.1, 3, 0.2));
    run("join");
    const JoinedBodies bodies = joined_bodies(model());
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_LT((model().blocks.angular_momentum[0] - momentum).norm(), 1e-9 * momentum.norm());
    run("cycle 2000");
    EXPECT_EQ(model().contacts.size(), 0u);
    EXPECT_LT((corner() - whole).norm(), 1e-9);
    EXPECT_LT((model().blocks.rotational_velocity[2] - spin).norm(), 1e-9);
    EXPECT_NEAR(model().energy.kinetic, energy, 1e-9 * energy);
    EXPECT_LT((model().blocks.angular_momentum[0] - momentum).norm(), 1e-9 * momentum.norm());
}

TEST_F(Joined, BlocksWithoutContactStaySeparate) {
    run("poly brick 0 1\npoly brick 1 2 0 1 0 1\npoly brick 3 4 0 1 0 1\npoly brick 3 4 1 2 1 2\njoin");
    EXPECT_EQ(model().blocks.body, (std::vector<std::int32_t>{1, 1, 0, 0}));
    EXPECT_THAT(said(), HasSubstr("2 blocks joined to 1 body"));
    run("join off range x 1 2");
    EXPECT_EQ(model().blocks.body, (std::vector<std::int32_t>{0, 0, 0, 0}));
}

/// A bar of joined blocks with zones, fixed at one end and pulled at the other, at rest.
constexpr const char* pulled_bar =
    "gen edge 0.5\nprop mat 1 dens 2500 bulk 1e9 shear 0.75e9\n"
    "bound xvel 0 range x 0\nbound yvel 0 range x 0 y 0 z 0\nbound zvel 0 range x 0 y 0 z 0\n"
    "bound zvel 0 range x 0 y 1 z 0\nbound stress 1e6 0 0 0 0 0 range x 2\n";

TEST_F(Joined, BlocksWithZonesAreTiedAndAreAsLongAsOneBlock) {
    const auto elongation = [&] {
        double sum = 0, count = 0;
        for (const Row g : select(model(), ObjectKind::gridpoint, {}))
            if (model().gridpoints.reference[g].x() == 2) {
                sum += model().gridpoints.displacement[g].x();
                ++count;
            }
        return sum / count;
    };
    run(std::string("poly brick 0 1 0 1 0 1\npoly brick 1 2 0 1 0 1\njoin\n") + pulled_bar +
        "jmodel jfric 10\nsolve ratio 1e-7");
    // Young's modulus is 1.8e9.
    EXPECT_NEAR(elongation(), 1e6 * 2 / 1.8e9, 1e-3 * elongation());
    EXPECT_EQ(model().contacts.size(), 0u);
    EXPECT_GT(model().ties.size(), 0u);
    run("list contacts");
    EXPECT_THAT(printed(), HasSubstr("no contacts"));
    EXPECT_EQ(session().program.warnings, 0u); // `jmodel` applies to future joints
    // Separated it is a joint, without tension.
    run("join off\njmodel model mohr jkn 1e10 jks 1e10\ncycle 10");
    EXPECT_EQ(model().ties.size(), 0u);
    EXPECT_GT(model().sub_contacts.size(), 0u);
    for (std::size_t s = 0; s < model().sub_contacts.size(); ++s) EXPECT_EQ(model().sub_contacts.normal_force[s], 0);
}

TEST_F(Joined, RemainsOfABodyWithZonesAreOneBodyOnlyWhereTied) {
    run("poly brick 0 1\npoly brick 1 2 0 1 0 1\npoly brick 2 3 0 1 0 1\npoly brick 3 4 0 1 0 1\ngen edge 1\njoin\n"
        "prop mat 1 dens 2500 bulk 1e9 shear 0.75e9\ncycle 1\ndelete range x 1 2\ncycle 1");
    EXPECT_EQ(model().blocks.body, (std::vector<std::int32_t>{0, 3, 3}));
    EXPECT_EQ(model().tied_pairs.size(), 1u);
    EXPECT_EQ(model().contacts.size(), 0u);
    run("join off\njmodel model elastic jkn 1e9 jks 1e9\ncycle 1");
    EXPECT_EQ(model().blocks.body, (std::vector<std::int32_t>{0, 0, 0}));
    EXPECT_EQ(model().tied_pairs.size(), 0u);
    EXPECT_EQ(model().contacts.size(), 1u);
    run("join\ncycle 1");
    EXPECT_EQ(model().tied_pairs.size(), 1u);
    EXPECT_EQ(model().contacts.size(), 0u);
}

TEST_F(Joined, AnExcavatedBlockIsUntiedAndReturnsUntied) {
    run("poly brick 0 1\npoly brick 1 2 0 1 0 1\npoly brick 2 3 0 1 0 1\ngen edge 1\njoin\n"
        "prop mat 1 dens 2500 bulk 1e9 shear 0.75e9\ncycle 1\nexcavate range x 2 3\ncycle 1");
    EXPECT_EQ(model().blocks.body, (std::vector<std::int32_t>{1, 1}));
    EXPECT_EQ(model().tied_pairs.size(), 1u);
    run("fill\njmodel model elastic jkn 1e9 jks 1e9\ncycle 1");
    EXPECT_EQ(model().blocks.body, (std::vector<std::int32_t>{1, 1, 0}));
    EXPECT_EQ(model().tied_pairs.size(), 1u);
    EXPECT_EQ(model().contacts.size(), 1u);
}

TEST_F(Joined, ArmsOfABodyInContactFormAJoint) {
    run("poly brick 0 1 0 1 0 0.49\npoly brick 0 1 0 1 0.51 1\npoly brick 1 2 0 1 0 1\ngen edge 0.5\njoin\n"
        "prop mat 1 dens 2500 bulk 1e7 shear 0.75e7\njmodel model elastic jkn 1e9 jks 1e9\nfix range x 1 2\n"
        "bound zvel 0.5 range x 0 z 0 0.49\nbound zvel -0.5 range x 0 z 0.51 1\ncycle 1");
    EXPECT_EQ(model().blocks.body, (std::vector<std::int32_t>{1, 1, 1}));
    EXPECT_EQ(model().contacts.size(), 0u);
    const std::size_t ties = model().ties.size();
    run("cycle time 0.03");
    ASSERT_EQ(model().contacts.size(), 1u);
    double force = 0;
    for (const double part : model().sub_contacts.normal_force) force += part;
    EXPECT_GT(force, 0);
    EXPECT_EQ(model().ties.size(), ties);
}

TEST_F(Joined, AConcaveSolidCanHaveZones) {
    // An L of two convex parts stands on its foot as one body under its weight.
    run("poly prism a 0 0 0 2 0 0 2 0 1 1 0 1 1 0 2 0 0 2 b 0 1 0 2 1 0 2 1 1 1 1 1 1 1 2 0 1 2\ngen edge 0.5\n"
        "prop mat 1 dens 2500 bulk 1e8 shear 0.6e8\nbound zvel 0 range z 0\nbound xvel 0 range z 0\nbound yvel 0 range z 0\n"
        "gravity 0 0 -10\nsolve ratio 1e-5");
    ASSERT_GE(model().blocks.size(), 2u);
    double weight = 0;
    for (std::size_t g = 0; g < model().gridpoints.size(); ++g) weight += 10 * model().gridpoints.mass[g];
    EXPECT_NEAR(weight, 3 * 2500 * 10, 1e-6 * weight);
    // A part that is not tied to the others would be far away.
    double farthest = 0;
    for (const Vec3& way : model().gridpoints.displacement) farthest = std::max(farthest, way.norm());
    EXPECT_GT(farthest, 1e-5);
    EXPECT_LT(farthest, 2e-3);
}

TEST_F(Joined, AConcaveSolidIsOneBody) {
    run("poly prism a 0 0 0 2 0 0 2 0 1 1 0 1 1 0 2 0 0 2 b 0 1 0 2 1 0 2 1 1 1 1 1 1 1 2 0 1 2");
    ASSERT_GE(model().blocks.size(), 2u);
    double volume = 0;
    for (std::size_t b = 0; b < model().blocks.size(); ++b) {
        EXPECT_EQ(model().blocks.body[b], 1);
        volume += model().blocks.volume[b];
    }
    EXPECT_NEAR(volume, 3, 1e-12);
}

TEST_F(Joined, ACutSeparatesABodyAtThePlane) {
    // A bar of three bricks, cut across the middle of the second.
    run("poly brick 0 1\npoly brick 1 2 0 1 0 1\npoly brick 2 3 0 1 0 1\njoin\njset dip 90 dd 90 org 1.5 0 0");
    ASSERT_EQ(model().blocks.size(), 4u);
    const auto& c = model().blocks.centroid;
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b)
            EXPECT_EQ(joined(model(), static_cast<Row>(a), static_cast<Row>(b)), (c[a].x() < 1.5) == (c[b].x() < 1.5));
}

TEST_F(Joined, RemainsOfABodyStayJoinedWhereInContact) {
    run("poly brick 0 1\npoly brick 1 2 0 1 0 1\npoly brick 2 3 0 1 0 1\npoly brick 3 4 0 1 0 1\njoin\n"
        "delete range x 1 2");
    EXPECT_EQ(model().blocks.body, (std::vector<std::int32_t>{0, 3, 3}));
}

TEST_F(Joined, ABodyHasZonesAsAWholeOrNotAtAll) {
    run("poly brick 0 1\npoly brick 1 2 0 1 0 1\ngen edge 1 range x 0 1");
    EXPECT_THAT(mistake("join").message, HasSubstr("block 1 has zones and block 2 has none"));
    EXPECT_EQ(model().blocks.body, (std::vector<std::int32_t>{0, 0}));
    run("new\npoly brick 0 1\npoly brick 1 2 0 1 0 1\njoin");
    run("prop mat 1 dens 2000 k 1e9 g 1e9\ngen edge 1 range x 0 1"); // the parts in turn
    EXPECT_THAT(mistake("cycle 1").message,
                HasSubstr("block 1 has zones, and block 2, to which it is joined, has none"));
    run("gen edge 1\ncycle 1");
}

} // namespace
} // namespace kaya
