#include "mechanics/zones/shared_strains.hpp"
#include "mechanics/zones/run_zone_models.hpp"
#include "mechanics/zones/shared_faces.hpp"
#include "two_bricks.hpp"

#include <gtest/gtest.h>

#include <random>

namespace kaya {
namespace {

using test::Bench;

/// Two blocks of mohr-coulomb zones, one of them with more zones than a tile may have, with unequal zones and stresses.
struct FlowingBlocks : Bench {
    FlowingBlocks() {
        for (const int material : {1, 2}) {
            elastic(material, 2500, material * 1e9, material * 0.75e9);
            model.materials[material].cohesion = 1e5;
            model.materials[material].friction = 30;
            model.materials[material].tension = 1e9;
        }
        generate_zones(model, {brick({0, 0, 0}, {1, 1, 1}, 1)}, {7, 7, 7}, {1, 1, 1});
        generate_zones(model, {brick({5, 0, 0}, {6, 1, 1}, 2)}, {3, 3, 3}, {1, 1, 1});
        std::ranges::fill(model.blocks.constitutive, 2);
        for (Vec3& place : model.gridpoints.position) place += vector(0.01);
        for (std::size_t g = 0; g < model.gridpoints.size(); ++g) model.gridpoints.velocity[g] = vector(1);
        for (Stress& stress : model.zones.stress)
            for (int k = 0; k < 6; ++k) stress[k] = small(k < 3 ? 1e5 : 3e4) - (k < 3 ? 2e5 : 0);
        model.clock.time_step = 1e-4;
        model.settings.large_strain = false;
    }
    double small(double most) { return std::uniform_real_distribution<double>(-most, most)(random_); }
    Vec3 vector(double most) { return {small(most), small(most), small(most)}; }
    void share() { model.unreduced = strains_are_shared; }

    /// With the outer faces of cells, unless `plain`.
    std::vector<PointRow> step(bool plain = false) {
        ZoneLaws laws(model, joints.zones);
        if (!plain) find_shared_faces(model, laws);
        std::vector<PointRow> forces(laws.tiles.gridpoints.size());
        sums = run_zone_models(model, laws, scratch_, forces);
        points = laws.tiles.gridpoints;
        return forces;
    }

    ZoneSums sums;
    std::vector<Row> points; ///< gridpoints of the rows of forces

private:
    std::mt19937 random_{7};
    ZoneScratch scratch_;
};

void expect_equal(const std::vector<PointRow>& a, const std::vector<PointRow>& b, double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t p = 0; p < a.size(); ++p)
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[p].value[k], b[p].value[k], tolerance * a[p].value[3]);
}

bool any_yields(const Model& model) {
    return std::ranges::any_of(model.zones.state, [](std::uint32_t state) { return state != 0; });
}

TEST(SharedStrains, TheZonesTakeTheWorkThatTheirForcesDo) {
    for (const bool damped : {false, true}) {
        FlowingBlocks bench;
        bench.share();
        bench.model.settings.rayleigh_stiffness = damped ? 1e-3 : 0;
        const auto before = bench.step(), after = bench.step();
        EXPECT_TRUE(any_yields(bench.model));
        double work = 0;
        for (std::size_t p = 0; p < before.size(); ++p)
            for (int k = 0; k < 3; ++k)
                work -= 0.5 * (before[p].value[k] + after[p].value[k]) * bench.model.clock.time_step *
                        bench.model.gridpoints.velocity[bench.points[p]][k];
        EXPECT_NEAR(bench.sums.work + bench.sums.damped, work, 1e-11 * std::abs(work));
    }
}

TEST(SharedStrains, AnEvenStrainAndAnEvenStressAreThoseOfSeparateZones) {
    FlowingBlocks shared, separate;
    shared.share();
    separate.model.settings.mixed_discretisation = false;
    std::ranges::fill(separate.model.blocks.cell_zones, 0);
    std::vector<PointRow> forces[2];
    int i = 0;
    for (FlowingBlocks* bench : {&shared, &separate}) {
        Model& model = bench->model;
        for (std::size_t g = 0; g < model.gridpoints.size(); ++g) {
            const Vec3& x = model.gridpoints.position[g];
            model.gridpoints.velocity[g] = {2 * x.x() + 3 * x.y(), x.z() - x.y(), 4 * x.x() - 6 * x.z()};
        }
        for (Stress& stress : model.zones.stress) stress << -2e5, -1e5, -3e5, 2e4, -3e4, 1e4;
        forces[i++] = bench->step(true);
        EXPECT_TRUE(any_yields(model));
    }
    for (std::size_t z = 0; z < shared.model.zones.size(); ++z)
        EXPECT_LT((shared.model.zones.stress[z] - separate.model.zones.stress[z]).norm(), 1e-6);
    expect_equal(forces[0], forces[1], 1e-11);
}

TEST(SharedStrains, AnEvenStressActsEvenlyOnTheCornersOfOuterFaces) {
    Bench bench;
    bench.elastic(1, 2500, 1e9, 0.75e9);
    generate_zones(bench.model, {bench.brick({0, 0, 0}, {1, 1, 1})}, {1, 1, 1}, {1, 1, 1});
    std::ranges::fill(bench.model.blocks.constitutive, 2);
    auto& material = bench.model.materials[1];
    material.cohesion = 1e9, material.friction = 30, material.tension = 1e9;
    bench.model.unreduced = strains_are_shared;
    for (Stress& stress : bench.model.zones.stress) stress << 0, 0, -4e6, 0, 0, 0;
    ZoneLaws laws(bench.model, bench.joints.zones);
    find_shared_faces(bench.model, laws);
    EXPECT_EQ(laws.tiles.shared_faces.size(), 6u);
    std::vector<PointRow> forces;
    zone_forces(bench.model, laws, forces);
    for (std::size_t p = 0; p < forces.size(); ++p) {
        const Vec3 x = bench.model.gridpoints.position[laws.tiles.gridpoints[p]];
        EXPECT_NEAR(forces[p].value[2], x.z() == 0 ? -1e6 : 1e6, 1e-6);
        EXPECT_NEAR(forces[p].value[0], 0, 1e-6);
    }
}

TEST(SharedStrains, PresentForcesAreThoseOfTheLastStep) {
    FlowingBlocks bench;
    bench.share();
    const auto after = bench.step();
    std::vector<PointRow> present;
    ZoneLaws laws(bench.model, bench.joints.zones);
    find_shared_faces(bench.model, laws);
    zone_forces(bench.model, laws, present);
    expect_equal(present, after, 1e-12);
}

TEST(SharedStrains, PorePressureIsNotShared) {
    FlowingBlocks dry, wet;
    for (FlowingBlocks* bench : {&dry, &wet}) {
        bench->share();
        std::ranges::fill(bench->model.gridpoints.velocity, Vec3(0, 0, 0));
        for (Stress& stress : bench->model.zones.stress) stress.setZero();
    }
    // The stress of the skeleton is zero in both: the total stress of wet zones is their pore pressure.
    Model& model = wet.model;
    model.settings.water = Water::points;
    for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
        model.gridpoints.pore_pressure[g] = 1e4 * (1 + model.gridpoints.position[g].z());
    for (std::size_t z = 0; z < model.zones.size(); ++z)
        for (const Row g : model.zones.gridpoints[z])
            for (int k = 0; k < 3; ++k) model.zones.stress[z][k] -= 0.25 * model.gridpoints.pore_pressure[g];
    const auto forces = wet.step(true);
    FlowingBlocks separate;
    std::ranges::fill(separate.model.blocks.cell_zones, 0);
    separate.model.zones.stress = model.zones.stress;
    std::vector<PointRow> expected;
    zone_forces(separate.model, ZoneLaws(separate.model, separate.joints.zones), expected);
    expect_equal(expected, forces, 1e-11);
}

} // namespace
} // namespace kaya
