#include "mechanics/zones/cell_stresses.hpp"
#include "model/fields/sampling.hpp"
#include "model/whole/state_hash.hpp"
#include "two_bricks.hpp"

#include <gtest/gtest.h>

#include <random>

namespace kaya {
namespace {

using test::Bench;

/// Blocks of cells in several tiles, the last group of some not full, in motion from a state without stress; some cells have zones with
/// different stresses.
struct MovingCells : Bench {
    MovingCells() {
        elastic(1, 2500, 1e9, 0.75e9);
        generate_zones(model, {brick({0, 0, 0}, {1, 1, 1})}, {7, 7, 7}, {1, 1, 1});
        generate_zones(model, {brick({2, 0, 0}, {3, 1, 1})}, {3, 3, 1}, {1, 1, 1});
        model.settings.large_strain = true;
        model.settings.damping = Damping::local;
        auto& g = model.gridpoints;
        std::mt19937 random(3);
        std::uniform_real_distribution<double> any(-1, 1);
        for (std::size_t p = 0; p < g.size(); ++p) g.velocity[p] = Vec3(any(random), any(random), any(random));
    }
    void run_unwatched(int cycles) {
        const Cycle::Unwatched unwatched(cycle);
        run(cycles);
    }
    void expect_the_same_as(MovingCells& other) {
        EXPECT_EQ(state_hash(model), state_hash(other.model));
        EXPECT_GT(model.zones.stress[0].norm(), 0);
    }
};

TEST(CellStresses, UnwatchedCyclesEndWithTheSameBits) {
    MovingCells watched, unwatched, in_turn;
    watched.run(41);
    unwatched.run_unwatched(41);
    unwatched.expect_the_same_as(watched);
    in_turn.run_unwatched(3);
    in_turn.run(2);
    in_turn.run_unwatched(36);
    in_turn.expect_the_same_as(watched);
}

TEST(CellStresses, AreCachedUntilTheyAreRead) {
    MovingCells watched, unwatched;
    watched.run(5);
    const Cycle::Unwatched held(unwatched.cycle);
    unwatched.run(5);
    EXPECT_EQ(unwatched.model.zones.stress[5], unwatched.model.zones.stress[6]); // not written back
    EXPECT_EQ(unwatched.cycle.energy_in_zones(), watched.cycle.energy_in_zones());
    unwatched.expect_the_same_as(watched);
    unwatched.run(5);
    watched.run(5);
    unwatched.cycle.bring_up_to_date();
    unwatched.expect_the_same_as(watched);
}

TEST(CellStresses, AreWrittenForHistoriesOfZones) {
    const auto stress_in_time = [](bool unseen) {
        MovingCells bench;
        HistorySource source;
        source.kind = ObjectKind::zone;
        source.quantity = "xx_stress";
        source.place = {0.4, 0.6, 0.7};
        bench.model.histories.interval = 4;
        bench.cycle.prepare();
        add_history(bench.model, source);
        unseen ? bench.run_unwatched(30) : bench.run(30);
        return bench.model.histories.all[0].values;
    };
    const auto values = stress_in_time(true);
    EXPECT_EQ(values.size(), 7u);
    EXPECT_EQ(values, stress_in_time(false));
}

TEST(CellStresses, CellsWithSeparateZonesStaySeparate) {
    MovingCells watched, unwatched;
    for (auto* bench : {&watched, &unwatched}) bench->model.zones.stress[100] = Stress::Constant(1e5);
    watched.run(20);
    unwatched.run_unwatched(20);
    unwatched.expect_the_same_as(watched);
}

TEST(CellStresses, AreThereWhenACycleFails) {
    MovingCells bench;
    bench.run_unwatched(3);
    {
        const Cycle::Unwatched unwatched(bench.cycle);
        bench.run(2);
        bench.model.gridpoints.velocity[5] = Vec3::Constant(1e9);
        EXPECT_ANY_THROW(bench.run(3));
    }
    for (std::size_t z = 0; z + 1 < bench.model.zones.size(); ++z)
        EXPECT_TRUE(bench.model.zones.stress[z].allFinite()) << z;
    EXPECT_GT(bench.model.zones.stress[5].norm(), 0);
}

} // namespace
} // namespace kaya
