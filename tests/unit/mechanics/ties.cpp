#include "mechanics/ties/ties.hpp"
#include "model/whole/state_hash.hpp"
#include "two_bricks.hpp"

#include "base/parallel.hpp"
#include "mechanics/cycle/insitu.hpp"
#include "model/edit/joined.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace kaya {
namespace {

using test::Bench;

constexpr double bulk = 1e9, shear = 0.75e9;

/// Three joined cubes in a row, with the given numbers of cells.
struct Row3 : Bench {
    std::vector<Row> blocks;

    explicit Row3(std::array<int, 3> cells, bool join = true) {
        elastic(1, 2500, bulk, shear);
        for (int k = 0; k < 3; ++k) {
            blocks.push_back(brick({1.0 * k, 0, 0}, {k + 1.0, 1, 1}));
            generate_zones(model, {blocks.back()}, {cells[k], cells[k], cells[k]}, {1, 1, 1});
        }
        if (join) join_pairs(model, {{blocks[0], blocks[1]}, {blocks[1], blocks[2]}});
        model.settings.energy = true;
    }
    std::vector<Row> at(double x) const {
        std::vector<Row> rows;
        for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
            if (std::abs(model.gridpoints.reference[g].x() - x) < 1e-9) rows.push_back(static_cast<Row>(g));
        return rows;
    }
    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
            sum += model.gridpoints.mass[g] * model.gridpoints.velocity[g];
        return sum;
    }
    double stored() const { return model.energy.zone_work; }
};

TEST(Ties, GridpointsOfMeshesThatMatchMoveAsOneToTheLastBit) {
    Row3 bench({2, 2, 2});
    bench.model.settings.damping = Damping::none;
    for (const Row g : bench.at(0)) bench.model.gridpoints.velocity[g] = {1, 0.5, -0.2};
    bench.run(500);
    const auto& g = bench.model.gridpoints;
    for (const double x : {1.0, 2.0}) {
        const auto rows = bench.at(x);
        ASSERT_EQ(rows.size(), 18u);
        for (const Row a : rows)
            for (const Row b : rows)
                if (g.reference[a] == g.reference[b]) {
                    EXPECT_EQ(g.velocity[a], g.velocity[b]);
                    EXPECT_EQ(g.position[a], g.position[b]);
                    EXPECT_EQ(g.displacement[a], g.displacement[b]);
                }
    }
    EXPECT_TRUE(bench.model.contacts.empty());
}

TEST(Ties, JoinedBlocksMoveAsOneBlockWithTheSameZones) {
    Row3 parts({2, 2, 2});
    Bench whole;
    whole.elastic(1, 2500, bulk, shear);
    const Row one = whole.brick({0, 0, 0}, {3, 1, 1});
    generate_zones(whole.model, {one}, {6, 2, 2}, {1, 1, 1});
    const auto load = [](Model& model) {
        for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
            if (model.gridpoints.position[g].x() == 3) model.gridpoints.load[g] = {2e4, 1e3, -3e3};
        std::vector<Row> held;
        for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
            if (model.gridpoints.position[g].x() == 0) held.push_back(static_cast<Row>(g));
        for (int k = 0; k < 3; ++k) prescribe_velocity(model, {{}, held}, k, 0);
        model.settings.given_time_step = 5e-5;
        model.settings.gravity = {0, 0, -10};
    };
    load(parts.model);
    load(whole.model);
    parts.run(400);
    whole.run(400);
    std::size_t compared = 0;
    double largest = 0;
    for (const Vec3& u : whole.model.gridpoints.displacement) largest = std::max(largest, u.norm());
    for (std::size_t a = 0; a < parts.model.gridpoints.size(); ++a)
        for (std::size_t b = 0; b < whole.model.gridpoints.size(); ++b)
            if ((parts.model.gridpoints.reference[a] - whole.model.gridpoints.reference[b]).norm() < 1e-12) {
                EXPECT_LT((parts.model.gridpoints.displacement[a] - whole.model.gridpoints.displacement[b]).norm(),
                          1e-9 * largest);
                ++compared;
            }
    EXPECT_EQ(compared, parts.model.gridpoints.size());
    EXPECT_NEAR(parts.model.clock.average_ratio, whole.model.clock.average_ratio,
                1e-6 * whole.model.clock.average_ratio);
}

class TiesOfMeshes : public testing::TestWithParam<std::array<int, 3>> {};
INSTANTIATE_TEST_SUITE_P(ties, TiesOfMeshes,
                         testing::Values(std::array{2, 2, 2}, std::array{2, 3, 2}, std::array{1, 3, 4}));

TEST_P(TiesOfMeshes, KeepMomentumAndEnergyOfAFreeBody) {
    Row3 bench(GetParam());
    std::ranges::fill(bench.model.blocks.cell_zones,
                      0); // cells would store energy by bending, too, which stored() does not count
    bench.model.settings.damping = Damping::none;
    bench.model.settings.time_step_fraction = 0.05; // the account is of second order in the step
    for (const Row g : bench.at(0)) bench.model.gridpoints.velocity[g] = {0.1, 0.05, -0.02};
    bench.cycle.prepare();
    const Vec3 before = bench.momentum();
    bench.run(1);
    const double start = bench.model.energy.start;
    double least = 1e300, most = 0;
    for (int i = 0; i < 3000; ++i) {
        bench.cycle.advance();
        const double whole = bench.model.energy.kinetic + bench.stored();
        least = std::min(least, whole);
        most = std::max(most, whole);
    }
    EXPECT_LT((bench.momentum() - before).norm(), 1e-9 * before.norm());
    EXPECT_LT(std::abs(bench.model.energy.error()), 1e-3 * start);
    EXPECT_LT(most - least, 2e-2 * start); // the kinetic energy of the leap-frog is half a step earlier
}

TEST_P(TiesOfMeshes, AFieldOfStressInEquilibriumStays) {
    Row3 bench(GetParam());
    Stress stress;
    stress << -3e6, -1e6, -2e6, 0.5e6, -0.7e6, 0.2e6;
    find_contacts(bench.model, bench.joints);
    std::vector<Row> zones(bench.model.zones.size());
    std::iota(zones.begin(), zones.end(), 0);
    set_insitu_stress(bench.model, bench.joints, zones, {}, {stress, {Stress::Zero(), Stress::Zero(), Stress::Zero()}});
    std::vector<Row> all(bench.model.gridpoints.size());
    std::iota(all.begin(), all.end(), 0);
    add_stress(bench.model, all, {stress, {Stress::Zero(), Stress::Zero(), Stress::Zero()}});
    bench.run(1);
    EXPECT_LT(bench.model.clock.average_ratio, 1e-9);
    bench.run(50);
    for (const Stress& s : bench.model.zones.stress) EXPECT_LT((s - stress).norm(), 1e-6 * stress.norm());
}

TEST_P(TiesOfMeshes, ARotationCausesNoStressAndRotatesExistingStress) {
    Row3 bench(GetParam());
    bench.model.settings.damping = Damping::none;
    const double step = 1e-5;
    bench.model.settings.given_time_step = step;
    bench.cycle.prepare();
    auto& g = bench.model.gridpoints;
    const Vec3 centre(1.5, 0.5, 0.5), spin(3, -1, 2);
    // Every gridpoint is moved on its circle; the velocity of a step is that between its ends.
    const int steps = 400;
    const double angle = 0.5 * std::numbers::pi / steps;
    for (std::uint8_t& fixed : g.fixed) fixed = 7;
    for (std::size_t t = 0; t < bench.model.ties.size(); ++t)
        if (!bench.model.ties.exact[t]) bench.model.ties.force[t] = Vec3(1, 2, 3);
    const Mat3 turn = Eigen::AngleAxisd(angle, spin.normalized()).toRotationMatrix();
    for (int i = 0; i < steps; ++i) {
        for (std::size_t k = 0; k < g.size(); ++k)
            g.velocity[k] = (turn * (g.position[k] - centre) - (g.position[k] - centre)) / step;
        bench.cycle.advance();
    }
    const Vec3 turned = Eigen::AngleAxisd(0.5 * std::numbers::pi, spin.normalized()) * Vec3(1, 2, 3);
    for (std::size_t t = 0; t < bench.model.ties.size(); ++t)
        if (!bench.model.ties.exact[t]) { EXPECT_LT((bench.model.ties.force[t] - turned).norm(), 1e-3); }
    for (const Stress& s : bench.model.zones.stress) EXPECT_LT(s.norm(), 1e-3);
}

TEST_P(TiesOfMeshes, TheStepThatIsFoundIsStableAndTheSameBitsComeWithAnyNumberOfThreads) {
    const auto run = [&](int count) {
        set_threads(count);
        auto bench = std::make_unique<Row3>(GetParam());
        bench->model.settings.damping = Damping::none;
        bench->model.settings.time_step_fraction = 0.99;
        for (const Row g : bench->at(3)) bench->model.gridpoints.velocity[g] = {0.1, 0, 0.3};
        bench->run(2000);
        return bench;
    };
    const int before = threads();
    const auto one = run(1), two = run(2), four = run(4);
    set_threads(before);
    EXPECT_EQ(state_hash(one->model), state_hash(two->model));
    EXPECT_EQ(state_hash(one->model), state_hash(four->model));
    EXPECT_LT(one->model.energy.kinetic, 2 * one->model.energy.start);
    EXPECT_GT(one->model.energy.start, 0);
}

TEST(Ties, ASupportOfOneActsOnAllTiedGridpoints) {
    Row3 bench({2, 2, 2});
    bench.model.settings.gravity = {0, 0, -10};
    // Only the left one of the two sides at x = 1 is fixed: the two others are tied to it.
    std::vector<Row> left;
    for (const Row g : bench.at(1))
        if (bench.model.gridpoints.block[g] == bench.blocks[0]) left.push_back(g);
    for (int k = 0; k < 3; ++k) prescribe_velocity(bench.model, {{}, left}, k, 0);
    bench.run(20000);
    const auto& g = bench.model.gridpoints;
    double carried = 0;
    for (const Row row : left) carried -= g.force[row].z() + g.mass[row] * -10;
    EXPECT_NEAR(carried, 3 * 2500 * 10, 1e-3 * 75000);
    for (const Row row : bench.at(1)) EXPECT_EQ(g.velocity[row], Vec3(Vec3::Zero()));
}

TEST(Ties, ADrivenSideDrivesTheOtherAndTheAccountCloses) {
    Row3 bench({2, 2, 2});
    bench.model.settings.damping = Damping::none;
    std::vector<Row> left;
    for (const Row g : bench.at(1))
        if (bench.model.gridpoints.block[g] == bench.blocks[0]) left.push_back(g);
    TimeFunction wave;
    wave.kind = TimeFunction::Kind::sine;
    wave.frequency = 50;
    prescribe_velocity(bench.model, {{}, left}, 0, 0.1, time_function_row(bench.model, wave));
    double most = 0;
    for (int i = 0; i < 4000; ++i) {
        bench.cycle.advance();
        most = std::max(most, bench.model.energy.kinetic);
    }
    EXPECT_GT(most, 1);
    EXPECT_LT(std::abs(bench.model.energy.error()), 2e-3 * most);
}

TEST(Ties, DensityScalingGivesAGroupTheMassOfItsMembers) {
    Row3 bench({2, 3, 2});
    bench.model.settings.mass_scaling = MassScaling::full;
    bench.model.settings.gravity = {0, 0, -10};
    const auto base = bench.at(0);
    for (int k = 0; k < 3; ++k) prescribe_velocity(bench.model, {{}, base}, k, 0);
    int cycles = 0;
    do bench.cycle.advance();
    while (bench.model.clock.average_ratio > 1e-5 && ++cycles < 20000);
    EXPECT_LT(cycles, 20000);
    double carried = 0;
    const auto& g = bench.model.gridpoints;
    for (const Row row : base) carried -= g.force[row].z() - 10 * g.mass[row];
    EXPECT_NEAR(carried, 75000, 75);
}

} // namespace
} // namespace kaya
