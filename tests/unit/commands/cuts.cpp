// jset in a deck: conservation, dependence on the seed, properties of pieces.
#include "geometry/polyhedra/polyhedron.hpp"
#include "model/edit/build.hpp"
#include "model/whole/state_hash.hpp"
#include "running.hpp"

#include <Eigen/Geometry>
#include <chrono>
#include <gmock/gmock.h>
#include <thread>

namespace kaya {
namespace {

using testing::HasSubstr;

class Cuts : public Running {
protected:
    double volume() {
        double sum = 0;
        for (const double v : model().blocks.volume) sum += v;
        return sum;
    }
    Vec3 first_moment() {
        Vec3 sum = Vec3::Zero();
        for (std::size_t b = 0; b < model().blocks.size(); ++b)
            sum += model().blocks.volume[b] * model().blocks.centroid[b];
        return sum;
    }
    void three_sets(const std::string& seed) {
        run("poly brick 0 10 0 10 0 10\n"
            "jset dip 70 5 dd 200 10 spacing 1 .2 num 15 org 5 5 5 seed " +
            seed +
            "\n"
            "jset dip 40 5 dd 90 10 spacing 1 .2 num 15 org 5 5 5 persistence 0.8 seed " +
            seed +
            "\n"
            "jset dip 20 5 dd 0 10 spacing 1 .2 num 15 org 5 5 5 seed " +
            seed + "\n");
    }
};

TEST_F(Cuts, NoCutLeavesAnEdgeShorterThanTheTolerance) {
    const auto shortest_edge = [&](const std::string& tolerance) {
        run("poly brick 0 10 0 10 0 10\n"
            "jset dip 70 5 dd 200 10 spacing 1.5 .2 num 15 org 5 5 5 " +
            tolerance + "\njset dip 40 5 dd 90 10 spacing 1.5 .2 num 15 org 5 5 5 " + tolerance +
            "\njset dip 20 5 dd 0 10 spacing 1.5 .2 num 15 org 5 5 5 " + tolerance + "\n");
        double least = 1e300;
        for (std::size_t b = 0; b < model().blocks.size(); ++b) {
            const Polyhedron shape = shape_of(model(), static_cast<Row>(b));
            for (const auto& face : shape.faces)
                for (std::size_t i = 0; i < face.vertices.size(); ++i)
                    least = std::min(least, (shape.vertices[face.vertices[i]] -
                                             shape.vertices[face.vertices[(i + 1) % face.vertices.size()]])
                                                .norm());
        }
        EXPECT_NEAR(volume(), 1000, 1000 * 1e-12);
        return least;
    };
    EXPECT_LT(shortest_edge(""), 0.02);
    run("delete\n");
    EXPECT_GE(shortest_edge("tolerance 0.1"), 0.1);
    EXPECT_GT(model().blocks.size(), 100u);
    EXPECT_THAT(said(), HasSubstr("not made: too near to a corner of the block (tolerance 0.1)"));
    // A cut through a corner is not one that passes near it.
    run("delete\npoly brick 0 1 0 1 0 1\njset dip 45 dd 90 org 0 0 1 tolerance 0.2\n");
    EXPECT_EQ(model().blocks.size(), 2u);
}

TEST_F(Cuts, VolumeAndFirstMomentStay) {
    three_sets("0");
    EXPECT_GT(model().blocks.size(), 900u);
    EXPECT_NEAR(volume(), 1000, 1000 * 1e-12);
    EXPECT_LT((first_moment() - Vec3::Constant(5000)).norm(), 5000 * 1e-12);
}

TEST_F(Cuts, TheSameSeedGivesTheSameJoints) {
    three_sets("7");
    const auto first = state_hash(model());
    run("new");
    three_sets("7");
    EXPECT_EQ(state_hash(model()), first);
    run("new");
    three_sets("8");
    EXPECT_NE(state_hash(model()), first);
}

TEST_F(Cuts, SetsAreNumberedAndKeptOnFaces) {
    run("poly brick 0 1\njset org 0 0 .5\njset dip 90 dd 90 org .5 0 0");
    std::vector<int> of_set(3, 0);
    for (const auto set : model().faces.joint_set) ++of_set.at(static_cast<std::size_t>(set));
    EXPECT_EQ(of_set[1], 4); // one face of each of the four pieces
    EXPECT_EQ(of_set[2], 4);
    run("jset dip 90 dd 0 org 0 .5 0 id 9\njset org 0 0 .25");
    EXPECT_EQ(*std::max_element(model().faces.joint_set.begin(), model().faces.joint_set.end()), 10);
}

TEST_F(Cuts, PiecesKeepTheMotionOfTheBlock) {
    run("poly brick 0 2 0 1 0 1 reg 4 mat 2\ngroup block a");
    auto& blocks = model().blocks;
    blocks.velocity[0] = {1, 0, 0};
    blocks.rotational_velocity[0] = {0, 0, 2};
    blocks.load[0] = {8, 0, 0};
    blocks.fixed[0] = fix_z;
    run("jset dip 90 dd 90 org 0.5 0 0");
    ASSERT_EQ(blocks.size(), 2u);
    Vec3 load = Vec3::Zero();
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_EQ(blocks.region[b], 4);
        EXPECT_EQ(blocks.material[b], 2);
        EXPECT_EQ(model().group_names[blocks.group[b]], "a");
        EXPECT_EQ(blocks.fixed[b], fix_z);
        load += blocks.load[b];
        // The velocity at the old centroid (1, 0.5, 0.5), relative to the piece.
        const Vec3 arm = Vec3(1, 0.5, 0.5) - blocks.centroid[b];
        EXPECT_LT((blocks.velocity[b] + Vec3(0, 0, 2).cross(arm) - Vec3(1, 0, 0)).norm(), 1e-14);
    }
    EXPECT_EQ(load, Vec3(8, 0, 0));
    EXPECT_EQ(blocks.number[0], 1);
    EXPECT_EQ(blocks.number[1], 2);
}

TEST_F(Cuts, OneLineReportsTheCuts) {
    run("poly brick 0 1\npoly brick 5 6 0 1 0 1\njset org 0 0 .5 range x 0 1\njset org 0 0 .5000001");
    EXPECT_THAT(said(), HasSubstr("joint set 1: 1 block cut into 2, 0 left whole"));
    EXPECT_THAT(said(), HasSubstr("joint set 2: 1 block cut into 2, 2 left whole; 1 cut was not made: a piece would "
                                  "be thinner than 6.16e-06"));
}

TEST_F(Cuts, BlocksWithZonesAreLeftOut) {
    run("poly brick 0 1\ngen edge 1\npoly brick 5 6 0 1 0 1\njset org 0 0 .5");
    EXPECT_THAT(said(), HasSubstr("1 block with zones cannot be cut and was left out"));
    EXPECT_EQ(model().blocks.size(), 3u);
}

TEST_F(Cuts, OneInterruptEndsALongCutAndLeavesTheModelUnchanged) {
    run("poly brick 0 1 0 1 0 1\npoly brick 1 2 0 1 0 1\n");
    const std::uint64_t before = state_hash(model());
    for (const std::string line : {"jset dip 30 dd 40 spacing 4e-5 num 20000 org 1 .5 .5", "densify 1000 1000 2"}) {
        std::jthread user([this] {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            session().interrupt();
        });
        const Diagnostic stopped = mistake(line);
        EXPECT_THAT(stopped.message, HasSubstr("stopped by the user"));
        EXPECT_EQ(stopped.place.line, 1);
        EXPECT_EQ(state_hash(model()), before);
    }
}

} // namespace
} // namespace kaya
