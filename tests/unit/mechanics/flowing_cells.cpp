// Cells whose zones flow are the same cells as elastic ones until they do.
#include "mechanics/zones/cell_state.hpp"
#include "mechanics/zones/ruled_faces.hpp"
#include "mechanics/zones/run_zone_models.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "two_bricks.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace kaya {
namespace {

/// Distorted cells that move at random.
struct Cells : test::Bench {
    explicit Cells(double cohesion) {
        elastic(1, 2500, 1e9, 0.75e9);
        auto& material = model.materials[1];
        material.cohesion = cohesion;
        material.tension = 1e12;
        material.friction = 30;
        material.dilation = 10;
        generate_zones(model, {brick({0, 0, 0}, {1, 1, 1}, 1)}, {4, 3, 5}, {1, 1, 1});
        std::mt19937 random(7);
        distort(random);
        model.clock.time_step = 0.01;
    }

    /// Makes the zones those of a constitutive number.
    void become(std::int32_t number) {
        std::ranges::fill(model.blocks.constitutive, number);
        laws = ZoneLaws(model, joints.zones);
        find_ruled_faces(model, TieLists(), laws);
        settle_cells(model, laws);
        forces.resize(laws.tiles.gridpoints.size());
    }
    ZoneSums step() { return run_zone_models(model, laws, scratch, forces); }

    /// Of initial stresses that differ from zone to zone.
    void set_stress() {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> small(-1e4, 1e4);
        std::vector<Row> zones(model.zones.size());
        std::iota(zones.begin(), zones.end(), 0);
        for (const Row z : zones)
            for (int k = 0; k < 6; ++k) model.zones.stress[z][k] = small(random);
        note_initial_stress(model, zones);
    }

    ZoneLaws laws;
    ZoneScratch scratch;
    std::vector<PointRow> forces;
};

void expect_equal_forces(const Cells& a, const Cells& b, double part) {
    ASSERT_EQ(a.forces.size(), b.forces.size());
    for (std::size_t p = 0; p < a.forces.size(); ++p)
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_NEAR(a.forces[p].value[k], b.forces[p].value[k], part * b.forces[p].value[3]) << p << ' ' << k;
}

TEST(FlowingCells, AreElasticCellsUntilTheyFlow) {
    for (const bool large : {false, true})
        for (const bool set : {false, true}) {
            Cells strong(1e12), elastic(1e12);
            double work[2];
            int i = 0;
            for (Cells* cells : {&strong, &elastic}) {
                cells->model.settings.large_strain = large;
                if (large)
                    cells->model.clock.time_step = 1e-5; // strains of 5e-5: layers turn with the mean of their cell
                if (set) cells->set_stress();
                cells->become(cells == &strong ? 2 : 1);
                cells->step();
                work[i++] = cells->step().work;
            }
            expect_equal_forces(strong, elastic, large ? 1e-4 : 1e-11);
            EXPECT_NEAR(work[0], work[1], (large ? 1e-4 : 1e-11) * std::abs(work[1]));
        }
}

TEST(FlowingCells, TakeTheWorkThatTheirForcesDo) {
    Cells cells(1e6);
    Model& model = cells.model;
    model.settings.large_strain = false;
    cells.set_stress();
    cells.become(2);
    cells.step();
    const std::vector<PointRow> before = cells.forces;
    zone_forces(model, cells.laws, cells.forces);
    for (std::size_t p = 0; p < before.size(); ++p) EXPECT_EQ(before[p].value, cells.forces[p].value);
    const double taken = cells.step().work;
    double work = 0;
    for (std::size_t p = 0; p < before.size(); ++p) {
        const Vec3 shift = model.clock.time_step * model.gridpoints.velocity[cells.laws.tiles.gridpoints[p]];
        for (int k = 0; k < 3; ++k) work -= 0.5 * (before[p].value[k] + cells.forces[p].value[k]) * shift[k];
    }
    EXPECT_NEAR(taken, work, 1e-11 * std::abs(work));
    EXPECT_TRUE(std::ranges::any_of(model.zones.state, [](std::uint32_t state) { return state != 0; }));
}

TEST(FlowingCells, AChangeOfTheirLawKeepsTheForces) {
    Cells cells(1e12), same(1e12);
    for (Cells* some : {&cells, &same}) {
        some->set_stress();
        some->become(1);
        some->step();
    }
    for (const std::int32_t number : {2, 1, 2, 1}) {
        cells.become(number);
        zone_forces(cells.model, cells.laws, cells.forces);
        expect_equal_forces(cells, same, 1e-12);
    }
    EXPECT_LT((cells.model.zones.stress[9] - same.model.zones.stress[9]).norm(), 1e-6);
}

} // namespace
} // namespace kaya
