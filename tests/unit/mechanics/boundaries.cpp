#include "mechanics/face_conditions.hpp"
#include "two_bricks.hpp"

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

TEST(Boundaries, AQuietBaseTakesUpTheMotionOfAColumn) {
    Bench bench;
    Model& model = bench.model;
    bench.elastic(1, 2000, 1e9, 0.6e9);
    const Row b = bench.brick({0, 0, 0}, {1, 1, 10});
    generate_zones(model, {b}, {1, 1, 10}, {1, 1, 1});
    model.settings.damping = Damping::none;
    find_contacts(model, bench.joints);
    const auto points = all_gridpoints(model);
    prescribe_velocity(model, {{}, points}, 0, 0);
    prescribe_velocity(model, {{}, points}, 1, 0);
    initialize_velocity(model, {{}, points}, 2, 0.1);
    const auto base = gridpoints_where(model, [](const Vec3& x) { return x.z() < 0.1; });
    EXPECT_EQ(make_quiet(model, exterior_triangles(model, base), quiet_normal), 2u);
    const double energy = 0.5 * 2000 * 10 * 0.01, speed = std::sqrt((1e9 + 0.8e9) / 2000);
    bench.cycle.prepare();
    while (model.clock.time < 25 / speed) bench.cycle.advance();
    // Twice the length at the speed of the wave, and some: all has gone out but for what ten zones scatter of a front that
    // is a jump.
    EXPECT_LT(model.energy.kinetic, 0.005 * energy);
    EXPECT_GT(model.energy.damped, 0.99 * energy);
    EXPECT_NEAR(model.energy.error(), 0, 1e-3 * energy);
}

TEST(Boundaries, RollersHoldAlongNormalsAndWorkAsTheBoundary) {
    Bench bench;
    Model& model = bench.model;
    bench.elastic(1, 2000, 1e9, 0.6e9);
    const Row b = bench.brick({0, 0, 0}, {1, 1, 1});
    generate_zones(model, {b}, {2, 2, 2}, {1, 1, 1});
    model.settings.damping = Damping::none;
    find_contacts(model, bench.joints);
    const auto side = [&](int axis, double place) {
        return exterior_triangles(model, gridpoints_where(model, [=](const Vec3& x) { return std::abs(x[axis] - place) < 1e-9; }));
    };
    EXPECT_EQ(hold_normals(model, side(0, 0), 0.5), 9u);
    EXPECT_EQ(hold_normals(model, side(2, 1), -0.25), 9u);
    // Gridpoints of one face share a roller; those on the edge have one of their own with both directions.
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

} // namespace
} // namespace kaya
