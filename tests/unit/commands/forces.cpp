// list interfaces, list reactions: resultants of random assemblies balance weights and loads.
#include "running.hpp"

#include "geometry/polyhedra/random.hpp"
#include "commands/list/reactions.hpp"
#include "commands/list/interfaces.hpp"
#include "model/edit/joined.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <numeric>

namespace kaya {
namespace {

class Forces : public Running {
protected:
    Forces() { session().engine.joints.set_path({KAYA_TEST_JOINTS}); }
    void start(Random& random);
};

std::vector<Row> all_contacts(const Model& model) {
    std::vector<Row> rows(model.contacts.size());
    std::iota(rows.begin(), rows.end(), Row{0});
    return rows;
}

/// A floor, two columns of bricks with their own heights, a lintel of joined parts on them, and loads.
std::string assembly(Random& random) {
    std::string deck = "poly brick -4 4 -1 1 -1 0 group floor\n";
    int blocks = 1;
    double low = 1e9;
    for (const double x : {-2.0, 2.0}) {
        double z = 0;
        for (int k = 0; k < 2 + static_cast<int>(2 * random.uniform()); ++k, ++blocks) {
            const double high = x < 0 || k < 1 ? 0.3 + random.uniform() : low - z;
            if (high < 0.1) break;
            deck += fmt::format("poly brick {} {} -0.5 0.5 {} {}\n", x - 0.5 - 0.2 * random.uniform(), x + 0.6, z,
                                z + high);
            z += high;
        }
        low = std::min(low, z);
    }
    deck += "prop mat 1 dens 2400\n";
    deck += fmt::format("gravity {} {} -9.81\n", random.symmetric(), random.symmetric());
    deck += "jmodel model mohr\njmodel jkn 1e8 jks 5e7 jfric 40\nfix range group floor\n";
    return deck;
}

} // namespace

/// An assembly with a load on its third block.
void Forces::start(Random& random) {
    run("new\n" + assembly(random));
    model().blocks.load[2] = 1e3 * Vec3(random.symmetric(), random.symmetric(), random.symmetric());
}

TEST_F(Forces, InterfacesGiveTheForceOnEachBodyInAnyState) {
    Random random(60);
    for (int k = 0; k < 20; ++k) {
        start(random);
        run(fmt::format("damp local\ncycle {}\n", 1 + 40 * (k % 4)));
        const Model& m = model();
        std::vector<Vec3> sum(m.blocks.size(), Vec3::Zero()), moment = sum;
        for (const Interface& one : interfaces_of(m, all_contacts(m))) {
            sum[one.first] -= one.force;
            sum[one.second] += one.force;
            for (const auto& [block, sign] : {std::pair(one.first, -1.0), std::pair(one.second, 1.0)}) {
                const Vec3 arm = one.centre - Vec3(m.blocks.centroid[block]);
                moment[block] += sign * (one.moment + arm.cross(one.force));
            }
            // The point of action lies in the plane, and about it the force has no moment across the normal.
            const Vec3 to_point = one.point_of_action() - one.centre;
            const Vec3 rest = one.moment - to_point.cross(one.force);
            const double scale = one.force.norm();
            EXPECT_NEAR(to_point.dot(one.normal), 0, 1e-9);
            EXPECT_LE(rest.cross(one.force).norm(), 1e-9 * scale * scale) << k;
        }
        for (Row b = 0; b < static_cast<Row>(m.blocks.size()); ++b) {
            const double weight = m.blocks.mass[b] * 9.81;
            EXPECT_LE((sum[b] - Vec3(m.blocks.force[b])).norm(), 1e-9 * weight) << k << ' ' << b;
            EXPECT_LE((moment[b] - Vec3(m.blocks.moment[b])).norm(), 1e-9 * weight) << k << ' ' << b;
        }
    }
}

TEST_F(Forces, ReactionsBalanceWeightsAndLoadsAtRest) {
    Random random(61);
    for (int k = 0; k < 20; ++k) {
        start(random);
        run("damp local\nsolve ratio 1e-12 cycles 60000\n");
        const Model& m = model();
        const Reactions all = reactions_of(m, [](Row) { return true; });
        ASSERT_EQ(all.groups.size(), 1u);
        EXPECT_EQ(m.group_names[static_cast<std::size_t>(all.groups[0].group)], "floor");
        const double weight = all.weight.norm();
        EXPECT_LE((all.reaction + all.weight + all.load).norm(), 1e-9 * weight) << k;
        EXPECT_GT(all.load.norm(), 0);
        // Seen from the joints: what the bodies put on the floor.
        Vec3 on_floor = Vec3::Zero();
        for (const Interface& one : interfaces_of(m, all_contacts(m)))
            if (one.first == 0) on_floor -= one.force;
        EXPECT_LE((all.groups[0].force + all.groups[0].weight + on_floor).norm(), 1e-9 * weight) << k;
        EXPECT_TRUE(reactions_of(m, [](Row) { return false; }).groups.empty());
    }
}

TEST_F(Forces, ReactionsOfZonesBalanceTheirWeight) {
    run("poly brick 0 1 0 1 0 3\ngen edge 0.6\nprop mat 1 dens 2000 bulk 1e8 shear 6e7\ngravity 0 1 -9.81\n"
        "bound xvel 0 yvel 0 zvel 0 range z 0\nbound xload 300 range z 3\ndamp local\nsolve ratio 1e-12 cycles 60000\n");
    const Reactions all = reactions_of(model(), [](Row) { return true; });
    ASSERT_EQ(all.groups.size(), 1u);
    EXPECT_NEAR(all.weight.z(), -6000 * 9.81, 1e-6);
    EXPECT_GT(all.load.x(), 0);
    EXPECT_LE((all.reaction + all.weight + all.load).norm(), 1e-9 * all.weight.norm());
}

TEST_F(Forces, ListsOfForcesAreTextsWithTheirNumbers) {
    run("poly brick 0 1 0 1 -1 0 group foot\npoly brick 0 1 0 1 0 1\nprop mat 1 dens 1000\ngravity 0 0 -10\nfix range id 1\n"
        "jmodel model mohr\njmodel jkn 1e8 jks 1e8 jfric 45\n");
    model().blocks.load[1] = {2500, 0, 0};
    run("damp local\nsolve ratio 1e-9 cycles 20000\nlist interfaces\nlist reactions\nlist interfaces range jset 7\nlist reactions range id 2\n");
    const std::string text = printed();
    EXPECT_NE(text.find("  0.250"), std::string::npos) << text; // 2500 of 10000 at tan 45
    EXPECT_NE(text.find("(0.625"), std::string::npos) << text;  // 0.5 + 0.5 * 2500 / 10000
    EXPECT_NE(text.find("polygon: ("), std::string::npos) << text;
    EXPECT_NE(text.find("sum of reactions (-2500, "), std::string::npos) << text;
    EXPECT_NE(text.find("no interfaces in range"), std::string::npos) << text;
    EXPECT_NE(text.find("no supports in range"), std::string::npos) << text;
}

} // namespace kaya
