// Outer faces of cells: contacts, loads and quiet boundaries see the mean of both diagonals.
#include "mechanics/common/elastic_constants.hpp"
#include "mechanics/shape/face_conditions.hpp"
#include "mechanics/supports/quiet_boundary.hpp"
#include "model/edit/copy_blocks.hpp"
#include "model/edit/joined.hpp"
#include "model/edit/ties.hpp"
#include "model/measure/cell_faces.hpp"
#include "two_bricks.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>

namespace kaya {
namespace {

using test::Bench;

/// Blocks in cells.
struct Cells : Bench {
    Cells() { elastic(1, 2000, 1e9, 0.6e9); }
    Row cells(const Vec3& low, const Vec3& high, const std::array<int, 3>& parts) {
        const Row b = brick(low, high);
        generate_zones(model, {b}, parts, {1, 1, 1});
        return b;
    }
    std::vector<Row> top() const {
        std::vector<Row> rows;
        for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
            if (model.gridpoints.position[g].z() == 1) rows.push_back(static_cast<Row>(g));
        return rows;
    }
};

/// One cell of 1 m.
struct OneCell : Cells {
    OneCell() {
        cells({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
        find_contacts(model, joints);
    }
    static StressField pressing(double force) {
        StressField stress;
        stress.at_origin[2] = -force;
        return stress;
    }
};

TEST(CellFaces, HaveTwoHalvesAndAnotherDiagonal) {
    Cells bench;
    bench.cells({0, 0, 0}, {1, 1, 1}, {2, 3, 1});
    const Model& model = bench.model;
    for (Row t = 0; t < static_cast<Row>(model.triangles.size()); ++t) {
        const Row partner = partner_in_cell(model, t);
        ASSERT_NE(partner, no_row);
        EXPECT_EQ(partner_in_cell(model, partner), t);
        EXPECT_EQ(model.triangles.face[t], model.triangles.face[partner]);
        const auto area = [&](const TriangleCorners& g) {
            const auto& x = model.gridpoints.position;
            return Vec3(0.5 * (x[g[1]] - x[g[0]]).cross(x[g[2]] - x[g[0]]));
        };
        const auto others = other_diagonal(model.triangles.gridpoints[t], model.triangles.gridpoints[partner]);
        for (const auto& other : others) EXPECT_LT((area(other) - area(model.triangles.gridpoints[t])).norm(), 1e-15);
        EXPECT_NE(others[0], others[1]);
    }
}

TEST(CellFaces, ShareLoadsAndQuietBoundariesEvenly) {
    OneCell bench;
    Model& model = bench.model;
    EXPECT_EQ(add_stress(model, bench.top(), bench.pressing(4e6)), 1);
    for (const Row g : bench.top()) EXPECT_NEAR(model.gridpoints.load[g].z(), -1e6, 1e-8);
    EXPECT_EQ(make_quiet(model, exterior_triangles(model, bench.top()), quiet_normal), 2u);
    const QuietPoints points = quiet_points(model, std::vector<ElasticConstants>{{0.6e9, 1.2e9}});
    ASSERT_EQ(points.dashpot.size(), 4u);
    for (const Mat3& dashpot : points.dashpot) EXPECT_NEAR(dashpot(2, 2) / points.dashpot[0](2, 2), 1, 1e-14);
}

TEST(CellFaces, LoadOnOneHalfActsOnItsCorners) {
    OneCell bench;
    Model& model = bench.model;
    const std::vector<Row> both = exterior_triangles(model, bench.top());
    EXPECT_EQ(add_stress_on(model, {both[0]}, bench.pressing(6e6)), 0.5);
    for (const Row g : model.triangles.gridpoints[both[0]]) EXPECT_NEAR(model.gridpoints.load[g].z(), -1e6, 1e-8);
}

TEST(CellFaces, ShareTheirJointEvenlyWhereMeshesMatch) {
    Cells bench;
    bench.cells({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
    bench.cells({0, 0, 1}, {1, 1, 2}, {1, 1, 1});
    bench.joint("elastic", {{"jkn", 1e9}, {"jks", 1e9}});
    ASSERT_EQ(bench.model.sub_contacts.size(), 4u);
    for (const double area : bench.model.sub_contacts.area) EXPECT_NEAR(area, 0.25, 1e-12);
}

/// The mean of both diagonals on both sides: the forces of an even traction on the gridpoints of a joint.
TEST(CellFaces, HaveTheSameForcesOnBothSidesOfAJoint) {
    Cells bench;
    bench.cells({0, 0, 0}, {1, 1, 1}, {2, 2, 1});
    bench.cells({0, 0, 1}, {1, 1, 2}, {3, 3, 1});
    bench.joint("elastic", {{"jkn", 1e9}, {"jks", 1e9}});
    const Model& model = bench.model;
    EXPECT_NEAR(bench.area(), 1, 1e-12);
    std::vector<double> share(model.gridpoints.size(), 0);
    for (std::size_t s = 0; s < model.sub_contacts.size(); ++s)
        for (const Attachment& side : {model.sub_contacts.side1[s], model.sub_contacts.side2[s]})
            for (std::size_t k = 0; k < 3; ++k)
                share[side.gridpoints[k]] += side.weights[k] * model.sub_contacts.area[s];
    for (std::size_t g = 0; g < share.size(); ++g) {
        const Vec3 x = model.gridpoints.position[g];
        if (x.z() != 1) continue;
        const int parts = model.gridpoints.block[g] == 0 ? 2 : 3;
        const auto width = [&](double at) { return (at == 0 || at == 1 ? 0.5 : 1.0) / parts; };
        EXPECT_NEAR(share[g], width(x.x()) * width(x.y()), 1e-12);
    }
}

TEST(CellFaces, AreTrianglesWhereBlocksAreTied) {
    Cells bench;
    const Row a = bench.cells({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), b = bench.cells({0, 0, 1}, {1, 1, 2}, {3, 3, 3});
    Model& model = bench.model;
    join_pairs(model, {{a, b}});
    find_contacts(model, bench.joints);
    const std::vector<Row> tied = tied_faces(model);
    ASSERT_EQ(tied.size(), 2u);
    const CellFaces faces(model, tied);
    for (Row t = 0; t < static_cast<Row>(model.triangles.size()); ++t)
        EXPECT_EQ(faces.partner(t) == no_row, std::ranges::binary_search(tied, model.triangles.face[t]));
}

TEST(CellFaces, MirroredCopiesOfCellsMoveAsTheirOriginal) {
    Cells bench;
    Model& model = bench.model;
    const Row b = bench.cells({0, 0, 0}, {2, 1, 1}, {2, 1, 1});
    copy_blocks(model, {b}, {reflection({1, 0, 0}, {3, 0, 0})});
    put_in_block_order(model);
    model.settings.gravity = {0, 2, -10};
    std::vector<Row> base;
    for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
        if (model.gridpoints.position[g].z() == 0) base.push_back(static_cast<Row>(g));
    for (int axis = 0; axis < 3; ++axis) prescribe_velocity(model, {{}, base}, axis, 0);
    bench.run(100);
    const Span own = model.blocks.gridpoints[0], copy = model.blocks.gridpoints[1];
    ASSERT_EQ(own.count, copy.count);
    double most = 0;
    for (Row g = 0; g < own.count; ++g) {
        const Vec3 d = model.gridpoints.displacement[own.first + g], c = model.gridpoints.displacement[copy.first + g];
        EXPECT_LT((d - Vec3(-c.x(), c.y(), c.z())).norm(), 1e-12);
        most = std::max(most, d.norm());
    }
    EXPECT_GT(most, 1e-6);
}

} // namespace
} // namespace kaya
