#include "mechanics/cycle/grid_pass.hpp"
#include "base/diagnostic.hpp"
#include "base/parallel.hpp"
#include "mechanics/motion/move_bodies.hpp"
#include "mechanics/ties/ties.hpp"
#include "model/whole/state_hash.hpp"
#include "two_bricks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>

namespace kaya {
namespace {

using test::Bench;

/// Two blocks with gridpoints in several chunks each, and small blocks, some of them rigid. Some gridpoints are fixed, some on a roller,
/// some loaded.
struct ManyZones : Bench {
    explicit ManyZones(bool large, Damping damping = Damping::local) {
        elastic(1, 2500, 1e9, 0.75e9);
        generate_zones(model, {brick({0, 0, 0}, {1, 1, 1})}, {13, 13, 13}, {1, 1, 1});
        for (int i = 0; i < 60; ++i) {
            const Row small = brick({2.0 + 2 * i, 0, 0}, {3.0 + 2 * i, 1, 1});
            if (i % 7 != 0) generate_zones(model, {small}, {2, 2, 2}, {1, 1, 1});
        }
        generate_zones(model, {brick({0, 5, 0}, {1, 6, 1})}, {9, 11, 13}, {1, 1, 1});
        model.settings.large_strain = large;
        model.settings.damping = damping;
        model.settings.gravity = {0, 0, -9.81};
        auto& g = model.gridpoints;
        std::mt19937 random(11);
        std::uniform_real_distribution<double> any(-1, 1);
        for (std::size_t p = 0; p < g.size(); ++p) {
            if (!model.blocks.deformable[g.block[p]]) continue;
            g.velocity[p] = 0.01 * Vec3(any(random), any(random), any(random));
            if (g.block[p] % 5 == 0) g.load[p] = 1e3 * Vec3(any(random), any(random), any(random));
            if (any(random) > 0.95) g.fixed[p] = fix_x | fix_z;
        }
        for (auto& stress : model.zones.stress)
            for (int k = 0; k < 6; ++k) stress[k] = 1e4 * any(random);
        cycle.prepare();
    }
};

/// Results of the phases.
struct Parts {
    Model model;
    ZoneLaws laws;
    std::vector<ElasticConstants> elastic;
    TieLists ties;
    Adjacency adjacency;
    QuietPoints quiet;
    JointForces joints;
    MemberLists members;
    ZoneScratch scratch;
    std::vector<PointRow> rows;
    PointForces forces{adjacency, ties, joints, laws.tiles, rows};
    MotionSums motion;
    ZoneSums zones;
    double power = 0;

    explicit Parts(ManyZones& bench)
        : model(bench.model), laws(model, bench.joints.zones), elastic(laws.elastic_constants()), ties(model, elastic),
          adjacency(make_adjacency(model)), members(model) {
        zone_forces(model, laws, rows);
        gather_forces(model, forces, members);
    }
    void one_by_one(int steps) {
        for (int i = 0; i < steps; ++i) {
            motion = move_gridpoints(model, quiet, ties);
            zones = run_zone_models(model, laws, scratch, rows);
            power = gather_forces(model, forces, members);
        }
    }
    /// Returns the fraction of the chunks that are gathered in the pass.
    double in_one_pass(int steps, int threads, bool loads_stay = true) {
        GridPass pass(model, laws.tiles, threads);
        double part = 0;
        for (int i = 0; i < steps; ++i) {
            pass.run(model, quiet, laws, scratch, forces, loads_stay, rows);
            motion = pass.motion();
            zones = pass.zones();
            const auto& done = pass.gathered().done;
            part = static_cast<double>(std::count(done.begin(), done.end(), 1)) / static_cast<double>(done.size());
            power = gather_forces(model, forces, members, pass.gathered());
            pass.forget_gathered();
        }
        return part;
    }
};

struct InThreads {
    explicit InThreads(int count) { set_threads(count); }
    ~InThreads() { set_threads(before); }
    int before = threads();
};

class GridPasses : public testing::TestWithParam<int> {};

void expect_the_same(Parts& one, Parts& other) {
    EXPECT_EQ(state_hash(one.model), state_hash(other.model));
    EXPECT_EQ(one.motion.kinetic, other.motion.kinetic);
    EXPECT_EQ(one.motion.kinetic_before, other.motion.kinetic_before);
    EXPECT_EQ(one.motion.gravity, other.motion.gravity);
    EXPECT_EQ(one.motion.boundary, other.motion.boundary);
    EXPECT_EQ(one.motion.damped, other.motion.damped);
    EXPECT_EQ(one.motion.inner_power, other.motion.inner_power);
    EXPECT_EQ(one.zones.work, other.zones.work);
    EXPECT_EQ(one.zones.damped, other.zones.damped);
    EXPECT_EQ(one.power, other.power);
}

TEST_P(GridPasses, GiveTheBitsOfThePhasesOneByOne) {
    const InThreads threads(GetParam());
    for (const bool large : {false, true})
        for (const Damping damping : {Damping::local, Damping::none, Damping::combined}) {
            ManyZones bench(large, damping);
            Parts phases(bench), pass(bench), apart(bench);
            const std::uint64_t start = state_hash(pass.model);
            phases.one_by_one(3);
            // With more threads more tiles have gridpoints moved by several threads; their forces are gathered later.
            EXPECT_GT(pass.in_one_pass(3, GetParam()), GetParam() == 1 ? 0.99 : 0.1);
            EXPECT_EQ(apart.in_one_pass(3, GetParam(), false), 0);
            EXPECT_NE(state_hash(pass.model), start);
            expect_the_same(phases, pass);
            expect_the_same(phases, apart);
        }
}

/// Zones of several tiles are inverted in one step: the first is reported.
TEST_P(GridPasses, ReportTheFirstFailingZone) {
    const InThreads threads(GetParam());
    ManyZones bench(true);
    Parts phases(bench), pass(bench);
    const auto told = [&](Parts& parts, const auto& step) -> std::string {
        auto& zones = parts.model.zones;
        for (const std::size_t z : {zones.size() - 1, zones.size() / 2, std::size_t{2500}})
            parts.model.gridpoints.velocity[zones.gridpoints[z][3]] = {1e9, -1e9, 3e9};
        try {
            step();
        } catch (const Diagnostic& failure) { return failure.what(); }
        return "";
    };
    const std::string first = told(phases, [&] { phases.one_by_one(1); });
    EXPECT_NE(first.find("inside out"), std::string::npos) << first;
    EXPECT_EQ(told(pass, [&] { pass.in_one_pass(1, GetParam()); }), first);
}

INSTANTIATE_TEST_SUITE_P(Threads, GridPasses, testing::Values(1, 2, 3, 8));

} // namespace
} // namespace kaya
