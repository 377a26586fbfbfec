#include "geometry/mesh/face_mesh.hpp"
#include "geometry/mesh/mesh.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/surface/joint_set.hpp"
#include "geometry/polyhedra/random.hpp"
#include "geometry/surface/shapes.hpp"
#include "sound_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <map>
#include <set>

using namespace kaya;

namespace {

double mean_edge(const TetMesh& m) {
    std::set<std::pair<int, int>> edges;
    for (const auto& t : m.tetrahedra)
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) edges.insert(std::minmax(t[i], t[j]));
    double sum = 0;
    for (const auto& [a, b] : edges) sum += (m.points[a] - m.points[b]).norm();
    return sum / static_cast<double>(edges.size());
}

/// A cube of rock of edge 4 cut by three sets with the scatter of the pattern.
std::vector<Polyhedron> jointed_rock(const JointSet& pattern, double thinnest) {
    std::vector<Polyhedron> blocks{make_brick({0, 0, 0}, {4, 4, 4})};
    for (const auto& [dip, direction, id] : {std::tuple{20., 80., 1}, {70., 170., 2}, {65., 275., 3}}) {
        JointSet set = pattern;
        set.dip = dip;
        set.dip_direction = direction;
        set.spacing = 1;
        set.number = 9;
        set.origin = {2, 2, 2};
        set.id = id;
        const CutBlocks result = cut_blocks(blocks, set, thinnest);
        std::vector<Polyhedron> next;
        for (std::size_t i = 0; i < blocks.size(); ++i)
            if (!std::binary_search(result.parents.begin(), result.parents.end(), static_cast<int>(i)))
                next.push_back(blocks[i]);
        for (const auto& piece : result.pieces) next.push_back(piece.polyhedron);
        blocks = std::move(next);
    }
    return blocks;
}

Polyhedron wedge() {
    return make_prism({{0, 0, 0}, {2, 0, 0}, {0, 0, 1.5}}, {{0, 1, 0}, {2, 1, 0}, {0, 1, 1.5}}).parts.front();
}

} // namespace

TEST(Mesh, BricksKeepTheirRegularCells) {
    const Polyhedron brick = make_brick({0, 0, 0}, {1, 1, 1});
    const TetMesh m = make_mesh(brick, 0.25);
    expect_sound(brick, m);
    EXPECT_EQ(m.tetrahedra.size(), 6u * 64);
    EXPECT_NEAR(dihedral_angles(m).smallest, 45, 1e-9);
}

TEST(Mesh, CellsFollowTheEdgesOfABlockThatIsTurned) {
    for (const double degrees : {0.0, 25.0, -25.0}) {
        const Eigen::AngleAxisd turn(degrees * 3.14159265358979 / 180, Vec3::UnitZ());
        Polyhedron brick = make_brick({0, 0, 0}, {3, 2, 1});
        for (Vec3& x : brick.vertices) x = turn * x;
        const auto mesh = hexahedron_mesh(brick, {4, 3, 1}, {2, 0.5, 1});
        ASSERT_TRUE(mesh);
        expect_sound(brick, *mesh);
        EXPECT_EQ(mesh->tetrahedra.size(), 6u * 12);
        // Cells of 1, 2, 4 and 8 fifteenths of the length; of 4, 2 and 1 sevenths of the width.
        const std::vector<std::vector<double>> wanted{{0, 0.2, 0.6, 1.4, 3}, {0, 8.0 / 7, 12.0 / 7, 2}, {0, 1}};
        for (int axis = 0; axis < 3; ++axis) {
            std::set<long> places, expected;
            for (const Vec3& x : mesh->points) places.insert(std::lround(1e9 * (turn.inverse() * x)[axis]));
            for (const double place : wanted[axis]) expected.insert(std::lround(1e9 * place));
            EXPECT_EQ(places, expected) << "axis " << axis << " at " << degrees << " degrees";
        }
    }
    EXPECT_FALSE(hexahedron_mesh(wedge(), {1, 1, 1}));
}

TEST(Mesh, AnglesOfARegularTetrahedron) {
    const TetMesh m{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 3, 2}}, {}};
    EXPECT_NEAR(dihedral_angles(m).smallest, 70.528779, 1e-6);
    EXPECT_NEAR(dihedral_angles(m).largest, 70.528779, 1e-6);
}

TEST(Mesh, WedgesDrumsAndTetrahedraAtSeveralSizes) {
    const std::vector<Polyhedron> shapes{
        wedge(), make_drum({{0, 0, 0}, {0.3, 0.4, 2}, 1, 0.6, 10}),
        make_tetrahedron({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}),
        cut(make_brick({0, 0, 0}, {1, 1, 1}), {normal_from_dip(55, 30), {0.5, 0.5, 0.6}}, 1).below};
    for (const Polyhedron& shape : shapes)
        for (const double edge : {5.0, 0.5, 0.25, 0.12}) {
            const TetMesh m = make_mesh(shape, edge);
            expect_sound(shape, m);
            const auto angles = dihedral_angles(m);
            EXPECT_GT(angles.smallest, edge < 1 ? 19.9 : 10) << edge;
            EXPECT_LT(angles.largest, edge < 1 ? 145 : 155) << edge;
            if (edge < 0.2) { EXPECT_NEAR(mean_edge(m), edge, 0.1 * edge); }
        }
}

TEST(Mesh, BlocksOfThreeJointSets) {
    JointSet pattern;
    pattern.dip_deviation = 5;
    const std::vector<Polyhedron> blocks = jointed_rock(pattern, 0.02);
    const auto start = std::chrono::steady_clock::now();
    std::vector<double> smallest;
    std::size_t tetrahedra = 0;
    for (const Polyhedron& block : blocks) {
        const TetMesh m = make_mesh(block, 0.3);
        expect_sound(block, m);
        tetrahedra += m.tetrahedra.size();
        smallest.push_back(dihedral_angles(m).smallest);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::sort(smallest.begin(), smallest.end());
    RecordProperty("tetrahedra", static_cast<int>(tetrahedra));
    RecordProperty("seconds", std::to_string(seconds));
    RecordProperty("smallest_angle_of_worst_tenth", std::to_string(smallest[smallest.size() / 10]));
    EXPECT_GT(smallest[smallest.size() / 10], 10);
    EXPECT_GT(smallest[smallest.size() / 2], 18);
    EXPECT_GT(smallest[0], 0.1); // bounded by the sharpest wedge that the joints cut
}

TEST(Mesh, IsTheSameEveryTime) {
    const TetMesh first = make_mesh(wedge(), 0.2), second = make_mesh(wedge(), 0.2);
    EXPECT_EQ(first.points, second.points);
    EXPECT_EQ(first.tetrahedra, second.tetrahedra);
}

TEST(Mesh, RefusesEdgesThatMakeNoSense) {
    const auto message = [](double edge) -> std::string {
        try {
            make_mesh(wedge(), edge);
        } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
        return "accepted";
    };
    EXPECT_EQ(message(0), "the edge length of zones is 0, and must be above 0");
    EXPECT_EQ(message(-1), "the edge length of zones is -1, and must be above 0");
    EXPECT_EQ(message(1e-5), "an edge length of 1e-05 makes some 1.5e+16 zones in one block");
}

TEST(Mesh, SplintersBetweenJointsAreFilledToo) {
    // Without a limit of thickness the joints cut arbitrarily small splinters and corners.
    JointSet pattern;
    pattern.dip_deviation = pattern.dip_direction_deviation = 10;
    pattern.spacing_deviation = 0.5;
    const std::vector<Polyhedron> blocks = jointed_rock(pattern, 0);
    int splinters = 0;
    for (const Polyhedron& block : blocks) {
        splinters += thickness(block) < 0.02;
        expect_sound(block, make_mesh(block, 0.6));
    }
    EXPECT_GT(blocks.size(), 100u);
    EXPECT_GT(splinters, 3);
}

TEST(Mesh, NeedlesAcrossTheAxesAreFilledToo) {
    // Zones meet at few points, and most cannot be improved: a point that found no better place must not be tried at each of them.
    for (const Vec3& tip : {Vec3(1500, 1500, 1500), Vec3(2500, 80, 120), Vec3(-1500, 40, 2200)}) {
        const Polyhedron needle = make_tetrahedron({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), tip});
        const TetMesh m = make_mesh(needle, 20);
        expect_sound(needle, m);
        EXPECT_GT(m.tetrahedra.size(), 300u);
    }
}

TEST(Mesh, RefusesOutlinesThatCrossThemselves) {
    FaceOutline outline;
    outline.corners = {
        {0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {1, -1, 0}, {0, 3, 0}}; // the fourth corner is beyond the first side
    outline.between.resize(outline.corners.size());
    try {
        mesh_face(outline, 10);
        FAIL() << "it has a mesh";
    } catch (const Diagnostic& mistake) { EXPECT_EQ(mistake.message, "the outline of a face crosses itself"); }
}
