// Meshes with variable edges: fields, coarse blocks adjacent to fine ones, rows of growing cells.
#include "geometry/mesh/graded_points.hpp"
#include "geometry/mesh/mesh_plan.hpp"

#include "geometry/surface/shapes.hpp"
#include "base/diagnostic.hpp"
#include "shared_faces.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

using namespace kaya;

namespace {

double volume_of(const TetMesh& mesh, const std::array<int, 4>& t) {
    const Vec3& a = mesh.points[t[0]];
    return (mesh.points[t[1]] - a).dot((mesh.points[t[2]] - a).cross(mesh.points[t[3]] - a)) / 6;
}

double worst_angle_of(const TetMesh& mesh) {
    const DihedralAngles angles = dihedral_angles(mesh);
    return std::min(angles.smallest, 180 - angles.largest);
}

/// Mean edge of tetrahedra over the value of the field, nearer to a point than a distance, and beyond another.
std::array<double, 2> edges_over_field(const std::vector<TetMesh>& meshes, const EdgeField& field, double near,
                                       double far) {
    std::array<double, 2> sum{}, count{};
    for (const TetMesh& mesh : meshes)
        for (const auto& t : mesh.tetrahedra)
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < i; ++j) {
                    const Vec3 &a = mesh.points[t[i]], &b = mesh.points[t[j]];
                    const double r = (0.5 * (a + b) - field.center).norm();
                    if (r > near && r < far) continue;
                    sum[r >= far] += (a - b).norm() / field.at(0.5 * (a + b));
                    ++count[r >= far];
                }
    return {sum[0] / count[0], sum[1] / count[1]};
}

const std::array<Mat3, 3>& turns() {
    static const std::array<Mat3, 3> all{Mat3::Identity(), Vec3(1, -1, 1).asDiagonal().toDenseMatrix(),
                                         Eigen::AngleAxisd(0.9, Vec3(3, 1, -2).normalized()).toRotationMatrix()};
    return all;
}

/// A box is not halved in a direction in which it is narrow; in all three, this took 4^17 boxes.
TEST(GradedMesh, PointsOfASplinterOfTwentyKilometres) {
    Spacing spacing;
    spacing.field = [](const Vec3& x) {
        return std::min(2.0, 0.2 + 0.36 * std::max((x - Vec3(0, 100, 0)).norm() - 1, 0.0));
    };
    spacing.change = 0.36;
    for (const double width : {1e-3, 1e-9}) {
        const auto points = graded_points({0, 0, 0}, {width, 20000, 0}, spacing, {[](const Vec3&) { return 1.0; }, 0});
        EXPECT_GT(points.size(), 5000u) << width;
        EXPECT_LT(points.size(), 40000u) << width;
    }
}

/// Boxes outside of a block are left alone: a rod along the diagonal has 10^8 places for points in the box around it.
TEST(GradedMesh, PointsOfARodAcrossTheAxes) {
    Spacing spacing;
    spacing.field = [](const Vec3& x) { return 5 + 3e-4 * x.norm(); };
    spacing.change = 3e-4;
    const Vec3 end = Vec3::Constant(2000), along = end.normalized();
    std::size_t asked = 0;
    const auto depth = [&](const Vec3& x) {
        ++asked;
        return 10 - (x - x.dot(along) * along).norm();
    };
    const auto points = graded_points(Vec3::Zero(), end, spacing, {depth, 0.5});
    EXPECT_GT(points.size(), 3000u) << asked;
    EXPECT_LT(asked, 4e6);
    for (const Vec3& x : points) EXPECT_GE(depth(x), 0.5 * spacing.field(x));
}

} // namespace

/// Far from all edges of a brick, which divide its cells, a field may be fine: tetrahedra follow it then.
TEST(GradedMesh, EdgesFollowAFieldInsideOfABrick) {
    const std::vector<Polyhedron> brick{make_brick({0, 0, 0}, {10, 10, 10})};
    for (const Vec3& center : {Vec3(5, 5, 5), Vec3(3, 4, 10), Vec3(10, 10, 5), Vec3(10, 0, 0)}) {
        const EdgeField field(2, center, 0.4, 2, 5);
        const auto near = edges_over_field(meshes_of(MeshPlan(brick, field), 1), field, 1.5, 20)[0];
        EXPECT_NEAR(near, 1, 0.35) << center.transpose();
    }
}

TEST(GradedMesh, EdgesFollowAFieldInRockOfAnyShape) {
    constexpr std::uint64_t seeds = 8;
    double mean = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        std::vector<Polyhedron> blocks = rock(seed);
        const Vec3 way = seed % 2 ? Vec3(0, 0, 0) : Vec3(1e6, -1e6, 1e6);
        const Mat3& turn = turns()[seed % 3];
        move(blocks, turn, way);
        const EdgeField field(1.2, turn * Vec3(2, 2, 2) + way, 0.15, 0.6, 1.5);
        const MeshPlan plan(blocks, field);
        const auto meshes = meshes_of(plan, blocks.size());
        const Shared shared = shared_faces(blocks, meshes);
        EXPECT_EQ(shared.matching, shared.faces) << seed;
        EXPECT_GT(shared.faces, 20) << seed;
        for (std::size_t b = 0; b < blocks.size(); ++b) // points of faces are in their planes
            for (const auto& t : meshes[b].boundary)
                for (const int p : t.points) {
                    const auto& face = blocks[b].faces[t.face];
                    const Vec3 from_corner = meshes[b].points[p] - blocks[b].vertices[face.vertices[0]];
                    EXPECT_NEAR(face_normal(blocks[b], face).dot(from_corner), 0, 1e-8);
                }
        const auto [near, far] = edges_over_field(meshes, field, 0.8, 1.6);
        mean += near / seeds;
        EXPECT_NEAR(near, 1, 0.3) << seed;
        EXPECT_LT(far, 1.2) << seed; // blocks themselves are smaller there
        std::vector<Polyhedron> reversed(blocks.rbegin(), blocks.rend());
        const MeshPlan other(reversed, field);
        const auto same = meshes_of(other, blocks.size());
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            EXPECT_EQ(meshes[b].points, same[blocks.size() - 1 - b].points);
            EXPECT_EQ(meshes[b].tetrahedra, same[blocks.size() - 1 - b].tetrahedra);
        }
    }
    EXPECT_NEAR(mean, 1, 0.2);
}

TEST(GradedMesh, RefusesEdgesThatNoBlockOfTheSizeCanGrowFrom) {
    for (const double size : {1e-3, 1.0, 1e3})
        for (const Vec3& center : {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5), Vec3(-1e-6, 1, 0.3)}) {
            const std::vector<Polyhedron> blocks{make_brick(Vec3::Zero(), Vec3::Constant(size))};
            const auto refused = [&](double at_center, const Vec3& place) {
                try {
                    const MeshPlan plan(blocks, EdgeField(size, size * place, size * at_center, size, 5 * size));
                    meshes_of(plan, 1);
                } catch (const Diagnostic& problem) {
                    EXPECT_NE(problem.message.find("too short for zones that grow"), std::string::npos)
                        << problem.message;
                    return true;
                }
                return false;
            };
            for (const double edge : {1e-300, 1e-9, 5e-5}) EXPECT_TRUE(refused(edge, center)) << edge;
            for (const double edge : {2e-4, 1e-2}) EXPECT_FALSE(refused(edge, center)) << edge;
            EXPECT_FALSE(refused(1e-9, {-2, 0, 0})); // short edges are elsewhere
        }
}

TEST(GradedMesh, CellsOfBricksAreGradedAlike) {
    std::vector<Polyhedron> blocks;
    for (int i = 0; i < 3; ++i) blocks.push_back(make_brick({4.0 * i, 0, 0}, {4.0 * i + 4, 2, 2}));
    const EdgeField field(2, {0, 0, 1}, 0.5, 1.5, 8);
    for (const Mat3& turn : turns()) {
        std::vector<Polyhedron> turned = blocks;
        move(turned, turn, {10, 20, 30});
        const EdgeField there(2, turn * field.center + Vec3(10, 20, 30), 0.5, 1.5, 8);
        const MeshPlan plan(turned, there);
        const auto meshes = meshes_of(plan, turned.size());
        const Shared shared = shared_faces(turned, meshes);
        EXPECT_EQ(shared.faces, 2);
        EXPECT_EQ(shared.matching, 2);
        EXPECT_EQ(meshes.front().per_cell, 6);
        EXPECT_EQ(meshes.back().per_cell, 6);
        // Along the row cells grow between blocks, and within the first of them; across it all have the same number.
        EXPECT_GE(meshes.front().tetrahedra.size(), 2 * meshes.back().tetrahedra.size());
        double least = 1e9, most = 0;
        for (const auto& t : meshes.front().tetrahedra) {
            least = std::min(least, volume_of(meshes.front(), t));
            most = std::max(most, volume_of(meshes.front(), t));
        }
        EXPECT_GT(most, 1.4 * least); // 0.95/0.56 along the nearest edge, less along the three others of the row
    }
}

TEST(GradedMesh, ACoarseBlockNextToAFineOneGrowsFromItsFace) {
    // A pyramid with its square face on a cube that has zones of an eighth of its edges.
    Polyhedron cube = make_brick({0, 0, 0}, {4, 4, 1});
    for (const Mat3& turn : turns())
        for (const double far : {0.0, 1e6}) {
            std::vector<Polyhedron> blocks{
                cube, make_prism({{0, 0, 1}, {4, 0, 1}, {2, 0, 4}}, {{0, 4, 1}, {4, 4, 1}, {2, 4, 4}}).parts.front()};
            move(blocks, turn, Vec3::Constant(far));
            const MeshPlan first({blocks.begin(), blocks.begin() + 1}, 0.25);
            std::vector<Polyhedron> fine{blocks[0]}, coarse{blocks[1]};
            const MeshPlan fine_plan(fine, 0.25);
            std::vector<TetMesh> meshes = meshes_of(fine_plan, 1);
            const MeshPlan plan(coarse, 2, faces_there(blocks[0], meshes[0]));
            meshes.push_back(meshes_of(plan, 1).front());
            const Shared shared = shared_faces(blocks, meshes);
            EXPECT_EQ(shared.faces, 1);
            EXPECT_EQ(shared.matching, 1);
            EXPECT_GT(worst_angle_of(meshes[1]), 10);
            // As many zones as the face has triangles, and a few layers of growing size: fewer than with a fine mesh everywhere.
            EXPECT_LT(meshes[1].tetrahedra.size(), 9000u);
            EXPECT_GT(meshes[1].tetrahedra.size(), 1000u);
        }
}

TEST(GradedMesh, WideningRowsAreCutSeparately) {
    TunnelBlocks tunnel;
    tunnel.radius = 1;
    tunnel.begin = 0;
    tunnel.end = 0.5;
    for (const double boundary : {9.0, 24.0})
        for (const double edge : {0.25, 0.5, 1.0}) {
            if (boundary > 10 && edge < 0.5) continue; // many zones
            tunnel.boundary = boundary;
            tunnel.radial = 8;
            tunnel.tangential = 3;
            tunnel.axial = 1;
            tunnel.ratio = 1.25;
            const std::vector<Polyhedron> blocks = make_tunnel(tunnel);
            const MeshPlan plan(blocks, edge);
            const auto meshes = meshes_of(plan, blocks.size());
            const Shared shared = shared_faces(blocks, meshes);
            EXPECT_EQ(shared.matching, shared.faces);
            for (std::size_t b = 0; b < blocks.size(); ++b) {
                if (std::hypot(mass_properties(blocks[b]).centroid.x(), mass_properties(blocks[b]).centroid.z()) <
                    1.5) {
                    EXPECT_EQ(meshes[b].per_cell, 6) << "at the wall, edge " << edge;
                }
            }
        }
}

TEST(GradedMesh, GridpointsOnAWallHaveEqualSharesOfIt) {
    TunnelBlocks tunnel;
    tunnel.radius = 1;
    tunnel.boundary = 2;
    tunnel.radial = 3;
    tunnel.tangential = 2;
    tunnel.axial = 1;
    tunnel.begin = 0;
    tunnel.end = 0.4;
    for (const Mat3& turn : turns()) {
        std::vector<Polyhedron> blocks = make_tunnel(tunnel);
        move(blocks, turn, {5, 6, 7});
        const MeshPlan plan(blocks, 0.5);
        Places places;
        std::map<int, double> shares;
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            const TetMesh mesh = plan.mesh(b);
            for (const auto& t : mesh.boundary) {
                double area = 0.5 * (mesh.points[t.points[1]] - mesh.points[t.points[0]])
                                        .cross(mesh.points[t.points[2]] - mesh.points[t.points[0]])
                                        .norm();
                bool wall = true;
                for (const int p : t.points) {
                    const Vec3 x = turn.transpose() * (mesh.points[p] - Vec3(5, 6, 7));
                    wall &= std::hypot(x.x(), x.z()) < 1.001;
                }
                if (!wall) continue;
                for (const int p : t.points) shares[places.number(mesh.points[p])] += area / 3;
            }
        }
        ASSERT_EQ(shares.size(), 32u);
        for (const auto& [point, share] : shares) EXPECT_NEAR(share, shares.begin()->second, 1e-9);
    }
}
