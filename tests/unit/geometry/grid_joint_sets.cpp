// Joint sets between blocks, with zones and without, written to .3dgrid and read again.
#include "geometry/grid/joint_sets.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/polyhedra/random.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

using namespace kaya;

namespace {

using PlaceChange = std::function<Vec3(const Vec3&)>;

/// Pieces of a brick between four planes, each a joint set; meshes of neighbours do not fit.
struct CutBrick {
    std::vector<Polyhedron> shapes;
    std::vector<TetMesh> meshes; ///< none of every `rigid`-th block
};

CutBrick cut_brick(std::uint64_t seed, std::size_t rigid, const PlaceChange& frame, bool mirrored) {
    Random random(seed);
    CutBrick brick{{make_brick({0, 0, 0}, {4, 3, 2})}, {}};
    for (int set = 11; set < 15; ++set) {
        const Plane plane{normal_from_dip(90 * random.uniform(), 360 * random.uniform()),
                          {1 + 2 * random.uniform(), 1 + random.uniform(), 0.5 + random.uniform()}};
        std::vector<Polyhedron> next;
        for (const Polyhedron& one : brick.shapes) {
            const Cut parts = cut(one, plane, set);
            for (const Polyhedron* part : {&parts.below, &parts.above})
                if (!part->faces.empty()) next.push_back(*part);
            if (parts.below.faces.empty() && parts.above.faces.empty()) next.push_back(one); // not crossed
        }
        brick.shapes = std::move(next);
    }
    for (std::size_t i = 0; i < brick.shapes.size(); ++i) {
        const double edge = i % 2 == 0 ? 2.0 : 0.9;
        TetMesh& mesh = brick.meshes.emplace_back(i % rigid == 0 ? TetMesh{} : make_mesh(brick.shapes[i], edge));
        for (Vec3& v : brick.shapes[i].vertices) v = frame(v);
        for (Vec3& v : mesh.points) v = frame(v);
        if (!mirrored) continue;
        for (auto& face : brick.shapes[i].faces) std::ranges::reverse(face.vertices);
        for (auto& t : mesh.tetrahedra) std::swap(t[2], t[3]);
    }
    return brick;
}

std::vector<GridShape> grid_shapes_of(const CutBrick& brick) {
    std::vector<GridShape> shapes;
    for (std::size_t i = 0; i < brick.shapes.size(); ++i) {
        const bool zoned = !brick.meshes[i].tetrahedra.empty();
        shapes.push_back({static_cast<int>(i) + 1, 0, "", &brick.shapes[i], 1, zoned ? &brick.meshes[i] : nullptr});
    }
    return shapes;
}

/// The solids of a grid by block number, with the joint sets of their faces.
std::map<int, std::vector<Polyhedron>> solids_of(const Grid3d& grid) {
    std::map<int, std::vector<Polyhedron>> solids;
    for (const auto& block : grid.blocks)
        solids[block.number] = solid_from_surface(surface_of(grid, block), {1e-3, true}).parts;
    give_joint_sets(grid, [&](int number) { return &solids.at(number); });
    return solids;
}

Vec3 face_middle(const Polyhedron& shape, const Polyhedron::Face& face) {
    Vec3 sum = Vec3::Zero();
    for (const int v : face.vertices) sum += shape.vertices[static_cast<std::size_t>(v)];
    return sum / static_cast<double>(face.vertices.size());
}

/// Each face of a block has the joint set that it had, found by its direction and middle.
void expect_same_sets(const Polyhedron& before, const Polyhedron& after) {
    ASSERT_EQ(after.faces.size(), before.faces.size());
    const double size = size_of(before.vertices);
    for (const auto& face : before.faces) {
        const Vec3 normal = face_normal(before, face), middle = face_middle(before, face);
        const auto same = std::ranges::find_if(after.faces, [&](const auto& other) {
            return face_normal(after, other).dot(normal) > 0.9999 &&
                   std::abs(normal.dot(face_middle(after, other) - middle)) < 1e-6 * size;
        });
        ASSERT_NE(same, after.faces.end());
        EXPECT_EQ(same->joint_set, face.joint_set);
    }
}

void expect_sets_back(std::uint64_t seed, std::size_t rigid, const PlaceChange& frame, bool mirrored = false) {
    const CutBrick brick = cut_brick(seed, rigid, frame, mirrored);
    ASSERT_GT(brick.shapes.size(), 6U);
    auto shapes = grid_shapes_of(brick);
    for (int order = 0; order < 2; ++order) {
        const auto solids = solids_of(read_grid3d(write_grid3d(grid_of(shapes)), "a"));
        for (std::size_t i = 0; i < brick.shapes.size(); ++i) {
            const auto& parts = solids.at(static_cast<int>(i) + 1);
            ASSERT_EQ(parts.size(), 1U);
            expect_same_sets(brick.shapes[i], parts[0]);
        }
        std::ranges::reverse(shapes);
    }
}

} // namespace

TEST(GridJointSets, ComeBackInEveryFrame) {
    const auto same = [](const Vec3& v) { return v; };
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        expect_sets_back(seed, 1000, same); // all but the first have zones
        expect_sets_back(seed, 3, same);    // rigid ones between
        expect_sets_back(seed, 3, [&](const Vec3& v) { return Vec3(turn * v); });
        expect_sets_back(
            seed, 3, [](const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); }, true);
        expect_sets_back(seed, 3, [](const Vec3& v) { return Vec3(1000 * v); });
        expect_sets_back(seed, 3, [](const Vec3& v) { return Vec3(v + Vec3(1e5, -2e5, 3e4)); });
    }
}

/// Blocks that moved apart, and such that a neighbour covers in part.
TEST(GridJointSets, OfNeighboursThatMoved) {
    Polyhedron base = make_brick({0, 0, 0}, {4, 2, 1}), left = make_brick({0, 0, 1.0005}, {1.7, 2, 2}),
               right = make_brick({1.7, 0.3, 0.9995}, {4, 2.3, 2}), away = make_brick({0, 0, 1.2}, {4, 2, 2});
    for (Polyhedron* shape : {&base, &left, &right, &away})
        for (auto& face : shape->faces) face.joint_set = std::abs(face_normal(*shape, face).z()) > 0.5 ? 4 : 0;
    const TetMesh mesh = make_mesh(base, 2);
    const auto sets = joint_sets_between({{1, 0, "", &base, 1, &mesh}, {2, 0, "", &left}, {7, 0, "", &right}});
    ASSERT_EQ(sets.size(), 1U);
    EXPECT_EQ(sets[0].number, 4);
    EXPECT_EQ(sets[0].blocks, (std::vector<std::array<int, 2>>{{1, 2}, {1, 7}}));
    EXPECT_TRUE(joint_sets_between({{1, 0, "", &base, 1, &mesh}, {2, 0, "", &away}}).empty()); // too far
    EXPECT_EQ(joint_sets_between({{1, 0, "", &base}, {2, 0, "", &left}}).size(), 1U);          // of rigid ones too
    Polyhedron bare = left;
    for (auto& face : bare.faces) face.joint_set = 0;
    EXPECT_EQ(joint_sets_between({{1, 0, "", &bare}, {2, 0, "", &base}}).size(), 1U); // one side is enough
    for (auto& face : left.faces)
        if (face.joint_set == 4) face.joint_set = 5;
    EXPECT_TRUE(
        joint_sets_between({{1, 0, "", &base, 1, &mesh}, {2, 0, "", &left}}).empty()); // two sets: not one joint
}
