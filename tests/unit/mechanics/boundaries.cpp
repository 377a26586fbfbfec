#include "mechanics/shape/face_conditions.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/measure.hpp"
#include "two_bricks.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace kaya {
namespace {

using test::Bench;

std::vector<Row> gridpoints_where(const Model& model, const std::function<bool(const Vec3&)>& holds) {
    std::vector<Row> rows;
    for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
        if (holds(model.gridpoints.position[g])) rows.push_back(static_cast<Row>(g));
    return rows;
}

std::vector<Row> all_gridpoints(const Model& model) {
    return gridpoints_where(model, [](const Vec3&) { return true; });
}

/// An elastic column of square section without damping, in cells.
struct ZonedColumn : Bench {
    ZonedColumn(double height, const std::array<int, 3>& parts) {
        elastic(1, 2000, 1e9, 0.6e9);
        const Row b = brick({0, 0, 0}, {1, 1, height});
        generate_zones(model, {b}, parts, {1, 1, 1});
        model.settings.damping = Damping::none;
        find_contacts(model, joints);
    }
};

TEST(Boundaries, AQuietBaseTakesUpTheMotionOfAColumn) {
    ZonedColumn bench(10, {1, 1, 10});
    Model& model = bench.model;
    const auto points = all_gridpoints(model);
    prescribe_velocity(model, {{}, points}, 0, 0);
    prescribe_velocity(model, {{}, points}, 1, 0);
    initialize_velocity(model, {{}, points}, 2, 0.1);
    const auto base = gridpoints_where(model, [](const Vec3& x) { return x.z() < 0.1; });
    EXPECT_EQ(make_quiet(model, exterior_triangles(model, base), quiet_normal), 2u);
    const double energy = 0.5 * 2000 * 10 * 0.01, speed = std::sqrt((1e9 + 0.8e9) / 2000);
    bench.cycle.prepare();
    while (model.clock.time < 25 / speed) bench.cycle.advance();
    // More than twice the length at the wave speed: all energy has left except the scatter of a discontinuous front in ten zones.
    EXPECT_LT(model.energy.kinetic, 0.005 * energy);
    EXPECT_GT(model.energy.damped, 0.99 * energy);
    EXPECT_NEAR(model.energy.error(), 0, 1e-3 * energy);
}

TEST(Boundaries, RollersHoldAlongNormalsAndWorkAsTheBoundary) {
    ZonedColumn bench(1, {2, 2, 2});
    Model& model = bench.model;
    const auto side = [&](int axis, double place) {
        return exterior_triangles(
            model, gridpoints_where(model, [=](const Vec3& x) { return std::abs(x[axis] - place) < 1e-9; }));
    };
    EXPECT_EQ(hold_normals(model, side(0, 0), 0.5), 9u);
    EXPECT_EQ(hold_normals(model, side(2, 1), -0.25), 9u);
    // Gridpoints of one face share a roller; those on the edge have a separate one with both directions.
    EXPECT_EQ(model.rollers.size(), 4u);
    for (int i = 0; i < 50; ++i) bench.cycle.advance();
    int edge = 0;
    for (const Row g : all_gridpoints(model)) {
        const Vec3 x = model.gridpoints.reference[g], v = model.gridpoints.velocity[g];
        EXPECT_TRUE(x.x() != 0 || std::abs(v.x() + 0.5) < 1e-14) << v.x();
        EXPECT_TRUE(x.z() != 1 || std::abs(v.z() + 0.25) < 1e-14) << v.z();
        edge += x.x() == 0 && x.z() == 1;
    }
    EXPECT_EQ(edge, 3);
    EXPECT_GT(model.energy.boundary, 0);
    EXPECT_NEAR(model.energy.damped, 0, 1e-9 * model.energy.boundary);
    EXPECT_NEAR(model.energy.error(), 0, 0.02 * model.energy.boundary);
    free_faces(model, all_gridpoints(model), quiet_x | quiet_y | quiet_z);
    EXPECT_EQ(model.gridpoints.roller[0], 0);
}

/// Joined blocks: a T with a long bar, whose stem covers a part of it, and a foot.
struct JoinedTee : Bench {
    JoinedTee() {
        const std::vector<Row> rows{brick({0, 0, 2}, {3, 1, 3}), brick({1, 0, 0.5}, {1.5, 0.75, 2}),
                                    brick({0.8, 0, 0}, {2.6, 1, 0.5})};
        join_pairs(model, adjacent_pairs(model, rows));
        find_contacts(model, joints);
    }
    /// Of all loads, and of their moments about the origin.
    std::pair<Vec3, Vec3> load() const {
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
        for (std::size_t b = 0; b < model.blocks.size(); ++b) {
            force += model.blocks.load[b];
            moment += load_moment(model, static_cast<Row>(b)) + model.blocks.centroid[b].cross(model.blocks.load[b]);
        }
        return {force, moment};
    }
};

TEST(Boundaries, APressureActsOnTheOutsideOfAJoinedBodyOnly) {
    JoinedTee tee;
    StressField pressure;
    pressure.at_origin = {-5, -5, -5, 0, 0, 0};
    // On all sides: the loaded surface excludes the two sections, each from both sides.
    const double sections = 2 * 2 * 0.5 * 0.75, bar = 2 * (3 * 1 + 3 * 1 + 1 * 1),
                 stem = 2 * (0.5 * 0.75 + 0.5 * 1.5 + 0.75 * 1.5), foot = 2 * (1.8 * 1 + 1.8 * 0.5 + 1 * 0.5);
    EXPECT_NEAR(add_stress(tee.model, all_gridpoints(tee.model), pressure), bar + stem + foot - sections, 1e-9);
    const auto [force, moment] = tee.load();
    EXPECT_LT(force.norm(), 1e-12);
    EXPECT_LT(moment.norm(), 1e-12);
    // The single members are not in equilibrium: the stem is loaded at its sides, the bar from above.
    EXPECT_NEAR(tee.model.blocks.load[0].z(), -5 * 0.5 * 0.75, 1e-12);
    EXPECT_NEAR(tee.model.blocks.load[1].norm(), 0, 1e-12);
}

TEST(Boundaries, AWaterPressureLiftsAJoinedBodyByTheWeightOfWhatItDisplaces) {
    JoinedTee tee;
    StressField water; // its level at z = 4
    const double weight = 9810;
    for (int k = 0; k < 3; ++k) {
        water.at_origin[k] = -4 * weight;
        water.gradient[2][k] = weight;
    }
    add_stress(tee.model, all_gridpoints(tee.model), water);
    double volume = 0;
    Vec3 first_moment = Vec3::Zero();
    for (std::size_t b = 0; b < tee.model.blocks.size(); ++b) {
        volume += tee.model.blocks.volume[b];
        first_moment += tee.model.blocks.volume[b] * tee.model.blocks.centroid[b];
    }
    const auto [force, moment] = tee.load();
    EXPECT_LT((force - Vec3(0, 0, weight * volume)).norm(), 1e-9 * weight);
    EXPECT_LT((moment - weight * first_moment.cross(Vec3::UnitZ())).norm(), 1e-9 * weight);
}

TEST(Boundaries, TheVerticesOfARigidBlockGoWithItInSmallStrainToo) {
    Bench bench;
    Model& model = bench.model;
    bench.elastic(1, 2000, 0, 0);
    const std::vector<Row> rows{bench.brick({0, 0, 0}, {1, 1, 1}), bench.brick({3, 0, 0}, {4, 1, 1}),
                                bench.brick({4, 0, 0}, {5, 1, 1})};
    model.settings.damping = Damping::none;
    model.settings.large_strain = false;
    prescribe_velocity(model, {{rows[0]}, {}}, 0, 0.5);
    prescribe_velocity(model, {{rows[0]}, {}}, 5, 0.2);
    join_pairs(model, adjacent_pairs(model, rows));
    for (const Row b : {rows[1], rows[2]}) model.blocks.velocity[b] = {0, 0.25, 0};
    bench.run(20);
    const double time = model.clock.time;
    ASSERT_GT(time, 0);
    for (const Row g : bench.gridpoints_of(rows[0])) {
        const Vec3 arm = model.gridpoints.position[g] - Vec3(0.5, 0.5, 0.5);
        const Vec3 velocity = Vec3(0.5, 0, 0) + Vec3(0, 0, 0.2).cross(arm);
        EXPECT_LT((gridpoint_velocity(model, g) - velocity).norm(), 1e-15);
        EXPECT_LT((model.gridpoints.displacement[g] - time * velocity).norm(), 1e-12 * time);
        EXPECT_EQ(model.gridpoints.position[g], model.gridpoints.reference[g] + model.blocks.centroid[rows[0]]);
    }
    for (const Row g : bench.gridpoints_of(rows[2])) {
        EXPECT_LT((gridpoint_velocity(model, g) - Vec3(0, 0.25, 0)).norm(), 1e-15);
        EXPECT_LT((model.gridpoints.displacement[g] - time * Vec3(0, 0.25, 0)).norm(), 1e-12 * time);
    }
}

} // namespace
} // namespace kaya
