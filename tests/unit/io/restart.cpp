// A restored model continues like an uninterrupted one: the engine and the file together.
#include "io/save.hpp"

#include "model/whole/consistency.hpp"
#include "model/fields/sampling.hpp"
#include "model/whole/state_hash.hpp"
#include "tests/unit/mechanics/two_bricks.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

using test::Bench;

/// A zoned brick sheared over a rigid one: slip, moving contacts, histories.
void shear_bench(Bench& bench) {
    bench.elastic(1, 2500, 4e9, 3e9);
    const Row low = bench.brick({-1, -1, -1}, {2, 2, 0}), high = bench.brick({0, 0, 0}, {1, 1, 1});
    generate_zones(bench.model, {high}, 0.5);
    fix_blocks(bench.model, {low});
    bench.model.settings.gravity = {0, 0, -9.81};
    bench.joint("mohr", {{"jkn", 1e9}, {"jks", 5e8}, {"jfric", 20}});
    std::vector<Row> top;
    for (const Row g : bench.gridpoints_of(high))
        if (bench.model.gridpoints.position[static_cast<std::size_t>(g)].z() == 1) top.push_back(g);
    prescribe_velocity(bench.model, {{}, top}, 0, 0.5);
    bench.model.histories.interval = 7;
    add_history(bench.model, {HistorySource::Kind::global, "unbalanced_force"});
    add_history(bench.model, {HistorySource::Kind::sub_contact, "shear_stress", Vec3(0.5, 0.5, 0)});
}

} // namespace

TEST(Restart, CyclesAfterRestoreGiveTheSameBitsAsWithoutStopping) {
    Bench straight;
    shear_bench(straight);
    straight.run(600);
    ASSERT_EQ(inconsistency(straight.model), "");

    Bench first;
    shear_bench(first);
    first.run(300);
    const auto hash = state_hash(first.model);
    const std::string image = save_image(first.model, {});
    Bench second;
    restore_image(second.model, image, "x.sav");
    EXPECT_EQ(state_hash(second.model), hash);
    second.run(300);
    EXPECT_EQ(second.model.histories.all[1].values, straight.model.histories.all[1].values);
    EXPECT_EQ(state_hash(second.model), state_hash(straight.model));
}

TEST(Restart, ARestoreInTheSameRunGoesBack) {
    Bench bench;
    shear_bench(bench);
    bench.run(100);
    const std::string image = save_image(bench.model, {});
    bench.run(200);
    const auto hash = state_hash(bench.model);
    restore_image(bench.model, image, "x.sav");
    EXPECT_EQ(bench.model.clock.cycle, 100);
    bench.run(200);
    EXPECT_EQ(state_hash(bench.model), hash);
}

TEST(Restart, AModelThatNeverCycledCanBeSaved) {
    Bench bench;
    shear_bench(bench);
    ASSERT_EQ(inconsistency(bench.model), "");
    const std::string image = save_image(bench.model, {});
    bench.run(50);
    Bench restored;
    restore_image(restored.model, image, "x.sav");
    restored.run(50);
    EXPECT_EQ(state_hash(restored.model), state_hash(bench.model));
}

} // namespace kaya
