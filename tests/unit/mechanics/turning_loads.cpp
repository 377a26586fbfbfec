#include "geometry/polyhedra/cut.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "model/edit/cut_blocks.hpp"
#include "model/edit/excavation.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/measure.hpp"
#include "two_bricks.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kaya {
namespace {

using test::Bench;

/// A rotation about a random axis by up to 180 degrees; the same for a seed on every machine.
class Turns {
public:
    explicit Turns(unsigned seed) : engine_(seed) {}
    double number() { return static_cast<double>(engine_()) / static_cast<double>(std::mt19937::max()) * 2 - 1; }
    Vec3 vector() { return {number(), number(), number()}; }
    Mat3 turn() { return Eigen::AngleAxisd(3 * number(), vector().normalized()).toRotationMatrix(); }

private:
    std::mt19937 engine_;
};

/// A free, weightless and undamped brick of 2 x 1 x 2, in another position, size and orientation.
struct LoadedBrick : Bench {
    Row block;

    LoadedBrick(const Mat3& turn, const Vec3& shift, double size) {
        model.materials[1].density = 1000;
        model.settings.damping = Damping::none;
        Polyhedron shape = make_brick({-1, 0, -1}, {1, 1, 1});
        for (Vec3& vertex : shape.vertices) vertex = turn * (size * vertex) + shift;
        if (turn.determinant() < 0)
            for (auto& face : shape.faces) std::reverse(face.vertices.begin(), face.vertices.end());
        block = add_block(model, shape, {});
    }
    Row vertex_at(const Vec3& place) const {
        Row best = 0;
        for (const Row g : gridpoints_of(block))
            if ((model.gridpoints.position[g] - place).norm() < (model.gridpoints.position[best] - place).norm())
                best = g;
        return best;
    }
    void load(Row vertex, const Vec3& force, std::int32_t function = constant_in_time) {
        for (int axis = 0; axis < 3; ++axis) add_load(model, {vertex}, axis, force[axis], function);
    }
};

/// Kinetic energy at the end of the step, with momenta advanced by half of the next.
double rotation_energy(const Model& model, Row b) {
    return 0.5 * model.blocks.angular_momentum[b].dot(model.blocks.rotational_velocity[b]);
}

TEST(TurningLoads, ABlockOnItsCentroidSwingsAboutTheDirectionOfAForceOnAnEdge) {
    // A physical pendulum: I th'' = -2 F sqrt(2) sin th from 45 degrees: at most 2 F (sqrt(2) - 1) = 828.43
    // J.
    for (const bool mirrored : {false, true})
        for (const double size : {1e-3, 1.0, 1e3}) {
            Turns turns(7);
            Mat3 turn = turns.turn();
            if (mirrored) turn.col(1) *= -1;
            const Vec3 shift = size * 1e4 * turns.vector();
            LoadedBrick bench(turn, shift, size);
            Model& model = bench.model;
            const Row b = bench.block;
            prescribe_velocity(model, {{b}, {}}, 0, 0);
            prescribe_velocity(model, {{b}, {}}, 1, 0);
            prescribe_velocity(model, {{b}, {}}, 2, 0);
            const double force = 1000 * std::pow(size, 4); // so that times are independent of the length `size`
            const Vec3 direction = turn.col(0);
            for (const double y : {0.0, 1.0})
                bench.load(bench.vertex_at(turn * (size * Vec3(1, y, 1)) + shift), force * direction);
            model.settings.given_time_step = 0.005;
            bench.cycle.prepare();
            const double most = 2 * force * size * (std::sqrt(2.0) - 1);
            double highest = 0, way = 0;
            const Row tip = bench.vertex_at(turn * (size * Vec3(1, 0, 1)) + shift);
            const Vec3 start = model.gridpoints.position[tip];
            for (int i = 0; i < 4000; ++i) {
                const Vec3 before = model.gridpoints.position[tip];
                bench.cycle.advance();
                highest = std::max(highest, rotation_energy(model, b));
                way = 0.5 * direction.dot(before + model.gridpoints.position[tip]) - direction.dot(start);
                // The work of a constant force is force times displacement, to the middle of the step.
                ASSERT_NEAR(model.energy.boundary, 2 * force * way, 1e-6 * most) << size;
                ASSERT_NEAR(model.energy.error(), 0, 1e-3 * most) << size;
            }
            EXPECT_LT(highest, 1.001 * most) << size;
            EXPECT_GT(highest, 0.999 * most) << size;
        }
}

TEST(TurningLoads, TheAccountIsOfSecondOrder) {
    const auto worst = [](double step) {
        LoadedBrick bench(Mat3::Identity(), Vec3::Zero(), 1);
        bench.load(bench.vertex_at({1, 0, 1}), {1000, 300, -200});
        bench.model.settings.given_time_step = step;
        double error = 0;
        for (double t = 0; t < 4; t += step) {
            bench.cycle.advance();
            error = std::max(error, std::abs(bench.model.energy.error()));
        }
        return error;
    };
    const double coarse = worst(0.02), fine = worst(0.01);
    EXPECT_GT(coarse, 0); // it detects the integration error
    EXPECT_NEAR(coarse / fine, 4, 0.6);
}

TEST(TurningLoads, TheMomentFollowsTheBlockAtAnyPosition) {
    Turns turns(11);
    for (int trial = 0; trial < 50; ++trial) {
        LoadedBrick bench(turns.turn(), turns.vector(), 1);
        Model& model = bench.model;
        const Row b = bench.block;
        std::vector<std::pair<Row, Vec3>> forces;
        for (const Row g : bench.gridpoints_of(b)) forces.emplace_back(g, 100 * turns.vector());
        TimeFunction twice;
        twice.kind = TimeFunction::Kind::cosine;
        twice.frequency = 0; // 1 without end
        const std::int32_t function = time_function_row(model, twice);
        for (std::size_t i = 0; i < forces.size(); ++i)
            bench.load(forces[i].first, forces[i].second, i % 2 == 0 ? constant_in_time : function);
        initialize_velocity(model, {{b}, {}}, 3 + trial % 3, 2);
        model.settings.given_time_step = 0.01;
        for (int i = 0; i < 100; ++i) bench.cycle.advance();
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
        for (const auto& [g, f] : forces) {
            force += f;
            moment += (model.gridpoints.position[g] - model.blocks.centroid[b]).cross(f);
        }
        EXPECT_LT((model.blocks.load[b] - force).norm(), 1e-11 * 800);
        EXPECT_LT((load_moment(model, b) - moment).norm(), 1e-10 * 800) << trial;
    }
}

TEST(TurningLoads, JoinedBricksMoveAsTheBrickThatTheyMake) {
    LoadedBrick whole(Mat3::Identity(), Vec3::Zero(), 1);
    Bench halves;
    halves.model.materials[1].density = 1000;
    halves.model.settings.damping = Damping::none;
    halves.brick({-1, 0, -1}, {0, 1, 1});
    halves.brick({0, 0, -1}, {1, 1, 1});
    join_pairs(halves.model, {{0, 1}});
    const Vec3 force(300, -200, 100), far(-50, 80, 120);
    whole.load(whole.vertex_at({1, 0, 1}), force);
    whole.load(whole.vertex_at({-1, 1, 1}), far);
    const auto vertex = [&](Row block, const Vec3& place) {
        for (const Row g : halves.gridpoints_of(block))
            if ((halves.model.gridpoints.position[g] - place).norm() < 1e-9) return g;
        return no_row;
    };
    for (int axis = 0; axis < 3; ++axis) {
        add_load(halves.model, {vertex(1, {1, 0, 1})}, axis, force[axis]);
        add_load(halves.model, {vertex(0, {-1, 1, 1})}, axis, far[axis]);
    }
    whole.model.settings.given_time_step = halves.model.settings.given_time_step = 0.01;
    for (int i = 0; i < 500; ++i) {
        whole.cycle.advance();
        halves.cycle.advance();
    }
    EXPECT_LT((halves.model.blocks.rotational_velocity[0] - whole.model.blocks.rotational_velocity[0]).norm(), 1e-9);
    const Vec3 middle = 0.5 * (halves.model.blocks.centroid[0] + halves.model.blocks.centroid[1]);
    EXPECT_LT((middle - whole.model.blocks.centroid[0]).norm(), 1e-9);
    const double scale = std::abs(whole.model.energy.boundary);
    EXPECT_NEAR(halves.model.energy.boundary, whole.model.energy.boundary, 1e-8 * scale);
    EXPECT_NEAR(halves.model.energy.error(), whole.model.energy.error(), 1e-8 * scale);
}

TEST(TurningLoads, PiecesShareForcesAndMomentsAndRefilledBlocksHaveNone) {
    LoadedBrick bench(Mat3::Identity(), Vec3::Zero(), 1);
    Model& model = bench.model;
    TimeFunction always;
    always.kind = TimeFunction::Kind::cosine;
    const std::int32_t function = time_function_row(model, always);
    bench.load(bench.vertex_at({1, 0, 1}), {300, -200, 100});
    bench.load(bench.vertex_at({-1, 0, 1}), {100, 250, -50}, function);
    initialize_velocity(model, {{bench.block}, {}}, 4, 1);
    model.settings.given_time_step = 0.01;
    bench.run(60);
    const Vec3 force = model.blocks.load[0], about = model.blocks.centroid[0];
    const auto moment = [&] {
        Vec3 sum = Vec3::Zero();
        for (std::size_t b = 0; b < model.blocks.size(); ++b)
            sum += load_moment(model, static_cast<Row>(b)) +
                   (model.blocks.centroid[b] - about).cross(model.blocks.load[b]);
        return sum;
    };
    const Vec3 before = moment();
    const Cut two = cut(shape_of(model, 0), {Vec3(1, 0.3, 0.2).normalized(), about}, 1);
    CutBlocks pieces;
    pieces.pieces = {{two.above, 0}, {two.below, 0}};
    pieces.parents = {0};
    replace_by_pieces(model, {0}, pieces);
    ASSERT_EQ(model.blocks.size(), 2u);
    EXPECT_LT((model.blocks.load[0] + model.blocks.load[1] - force).norm(), 1e-9 * force.norm());
    EXPECT_LT((moment() - before).norm(), 1e-9 * before.norm());
    bench.joint("elastic", {{"stiffness-normal", 1e3}, {"stiffness-shear", 1e3}});
    bench.run(1); // time-dependent loads are set again
    EXPECT_LT((model.blocks.load[0] + model.blocks.load[1] - force).norm(), 1e-9 * force.norm());
    excavate_blocks(model, {0});
    fill_blocks(model, {0});
    const Row back = model.blocks.number[0] == 1 ? 0 : 1;
    EXPECT_TRUE(model.blocks.load_arms[back].isZero(0));
}

} // namespace
} // namespace kaya
