#include "geometry/mesh/mesh_plan.hpp"

#include "geometry/surface/shapes.hpp"
#include "shared_faces.hpp"
#include "sound_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>

using namespace kaya;

namespace {

Polyhedron wedge_on_cube() {
    return make_prism({{1, 0, 0}, {1, 0, 1}, {1.8, 0, 0}}, {{1, 1, 0}, {1, 1, 1}, {1.8, 1, 0}}).parts.front();
}

} // namespace

TEST(MeshPlan, BlocksOfJointSetsHaveTheSameTrianglesOnBothSides) {
    const Mat3 turned = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Mat3 mirrored = Vec3(-1, 1, 1).asDiagonal();
    int faces = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
        for (const double edge : {0.5, 1.2}) {
            std::vector<Polyhedron> blocks = rock(seed);
            if (seed % 4 == 1) move(blocks, turned, Vec3::Zero());
            if (seed % 4 == 2) move(blocks, mirrored, Vec3::Zero());
            if (seed % 4 == 3) move(blocks, Mat3::Identity(), {1e6, -1e6, 1e6});
            const MeshPlan plan(blocks, edge);
            const Shared shared = shared_faces(blocks, meshes_of(plan, blocks.size()));
            EXPECT_EQ(shared.matching, shared.faces) << "seed " << seed << " edge " << edge;
            faces += shared.faces;
        }
    EXPECT_GT(faces, 1000);
}

TEST(MeshPlan, CornersThatDifferByRoundingAreTheSame) {
    std::vector<Polyhedron> blocks = rock(5);
    Random random(3);
    for (Polyhedron& block : blocks)
        for (Vec3& x : block.vertices) x += 1e-11 * Vec3(random.symmetric(), random.symmetric(), random.symmetric());
    const MeshPlan plan(blocks, 0.5);
    const Shared shared = shared_faces(blocks, meshes_of(plan, blocks.size()));
    EXPECT_GT(shared.faces, 50);
    EXPECT_EQ(shared.matching, shared.faces);
}

TEST(MeshPlan, TheOrderOfBlocksDoesNotMatter) {
    const std::vector<Polyhedron> blocks = rock(2);
    const std::vector<Polyhedron> reversed(blocks.rbegin(), blocks.rend());
    const MeshPlan plan(blocks, 0.6), other(reversed, 0.6);
    const auto meshes = meshes_of(plan, blocks.size());
    auto others = meshes_of(other, blocks.size());
    std::ranges::reverse(others);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        EXPECT_EQ(meshes[b].points, others[b].points);
        EXPECT_EQ(meshes[b].tetrahedra, others[b].tetrahedra);
    }
}

TEST(MeshPlan, CellsGoOnFromBlockToBlock) {
    // The cells around a tunnel: sectors are wider outside than inside, and adjacent ones are rotated.
    TunnelBlocks tunnel;
    tunnel.radius = 1;
    tunnel.boundary = 2;
    tunnel.radial = 3;
    tunnel.tangential = 2;
    tunnel.axial = 2;
    tunnel.begin = 0;
    tunnel.end = 1;
    const std::vector<Polyhedron> blocks = make_tunnel(tunnel);
    const MeshPlan plan(blocks, 0.4);
    const auto meshes = meshes_of(plan, blocks.size());
    const Shared shared = shared_faces(blocks, meshes);
    EXPECT_EQ(shared.faces, 16 * 3 * 2 + 16 * 2 * 2 + 16 * 3);
    EXPECT_EQ(shared.matching, shared.faces);
    EXPECT_TRUE(std::ranges::all_of(meshes, [](const TetMesh& m) { return m.per_cell == 6; }));
}

TEST(MeshPlan, SlopesAreCutInCells) {
    // Blocks whose front is a slope of two to one and steeper, from the toe to different distances behind the crest.
    const Mat3 turned = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Mat3 mirrored = Vec3(-1, 1, 1).asDiagonal();
    for (const double run : {2.0, 1.7, 1.2, 1.0, 0.6})
        for (const double behind : {1.2, 2.0, 4.0})
            for (const Mat3& turn : {Mat3(Mat3::Identity()), turned, mirrored}) {
                const double far = run + behind;
                std::vector<Polyhedron> blocks = make_prism({{0, 0, 0}, {far, 0, 0}, {far, 0, 1}, {run, 0, 1}},
                                                            {{0, 0.1, 0}, {far, 0.1, 0}, {far, 0.1, 1}, {run, 0.1, 1}})
                                                     .parts;
                ASSERT_EQ(blocks.size(), 1u);
                move(blocks, turn, Vec3::Zero());
                EXPECT_EQ(MeshPlan(blocks, 0.1).mesh(0).per_cell, 6) << run << " " << behind;
            }
}

TEST(MeshPlan, OtherBlocksTakeTheFacesOfCells) {
    const std::vector<Polyhedron> blocks{wedge_on_cube(), make_brick({0, 0, 0}, {1, 1, 1})};
    const MeshPlan plan(blocks, 0.25);
    const auto meshes = meshes_of(plan, blocks.size());
    EXPECT_EQ(meshes[0].per_cell, 0);
    EXPECT_EQ(meshes[1].per_cell, 6);
    const Shared shared = shared_faces(blocks, meshes);
    EXPECT_EQ(shared.faces, 1);
    EXPECT_EQ(shared.matching, 1);
}

TEST(MeshPlan, BadBlocksAreImprovedAndTheirNeighboursStayFair) {
    const Mat3 turned = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Mat3 mirrored = Vec3(-1, 1, 1).asDiagonal();
    constexpr double fair = 18; // of a block that loses room to a neighbour, degrees
    int better = 0, divided = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
        for (const double edge : {0.5, 1.2}) {
            std::vector<Polyhedron> blocks = rock(seed);
            if (seed % 3 == 1) move(blocks, turned, Vec3::Zero());
            if (seed % 3 == 2) move(blocks, mirrored, Vec3::Zero());
            const MeshPlan plan(blocks, edge);
            std::vector<TetMesh> before;
            for (std::size_t b = 0; b < blocks.size(); ++b) before.push_back(plan.mesh(b));
            std::vector<TetMesh> after = before;
            plan.mend(after);
            for (std::size_t b = 0; b < blocks.size(); ++b) {
                expect_sound(blocks[b], after[b]);
                const auto was = dihedral_angles(before[b]), now = dihedral_angles(after[b]);
                const double worst = std::min(was.smallest, 180 - was.largest),
                             mended = std::min(now.smallest, 180 - now.largest);
                EXPECT_GE(mended, std::min(worst, fair) - 1e-9)
                    << "seed " << seed << " edge " << edge << " block " << b;
                better += mended > worst + 1;
                divided += after[b].boundary.size() > before[b].boundary.size();
            }
            const Shared shared = shared_faces(blocks, after);
            EXPECT_EQ(shared.matching, shared.faces) << "seed " << seed << " edge " << edge;
        }
    EXPECT_GT(better, 20);
    EXPECT_GT(divided, 5);
}

TEST(MeshPlan, ExistingFacesStayWhenBlocksAreImproved) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        std::vector<Polyhedron> blocks = rock(seed);
        const std::size_t half = blocks.size() / 2;
        std::vector<Polyhedron> first(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(half)),
            second(blocks.begin() + static_cast<std::ptrdiff_t>(half), blocks.end());
        auto meshes = meshes_of(MeshPlan(first, 1.2), first.size());
        std::vector<MeshedFace> there;
        for (std::size_t b = 0; b < first.size(); ++b)
            for (const MeshedFace& face : faces_there(first[b], meshes[b])) there.push_back(face);
        const MeshPlan plan(second, 1.2, there);
        for (TetMesh& mesh : meshes_of(plan, second.size())) meshes.push_back(std::move(mesh));
        for (std::size_t b = 0; b < blocks.size(); ++b) expect_sound(blocks[b], meshes[b]);
        const Shared shared = shared_faces(blocks, meshes);
        EXPECT_EQ(shared.matching, shared.faces) << "seed " << seed;
    }
}

TEST(MeshPlan, ExistingFacesAreReused) {
    // A fine wedge and cube; then their coarse neighbours: the mirror image of the wedge, and a cube below.
    std::vector<Polyhedron> fine{wedge_on_cube(), make_brick({0, 0, 0}, {1, 1, 1})};
    std::vector<Polyhedron> coarse{
        make_prism({{1, 0, 0}, {1, 0, -1}, {1.8, 0, 0}}, {{1, 1, 0}, {1, 1, -1}, {1.8, 1, 0}}).parts.front(),
        make_brick({0, 0, -1}, {1, 1, 0})};
    const MeshPlan first(fine, 0.2);
    auto meshes = meshes_of(first, fine.size());
    std::vector<MeshedFace> there;
    for (std::size_t b = 0; b < fine.size(); ++b)
        for (const MeshedFace& face : faces_there(fine[b], meshes[b])) there.push_back(face);
    const MeshPlan second(coarse, 0.6, there);
    for (TetMesh& mesh : meshes_of(second, coarse.size())) meshes.push_back(std::move(mesh));
    std::vector<Polyhedron> all = fine;
    all.insert(all.end(), coarse.begin(), coarse.end());
    const Shared shared = shared_faces(all, meshes);
    EXPECT_EQ(shared.faces, 4);
    EXPECT_EQ(shared.matching, 4);
    EXPECT_LT(meshes[2].tetrahedra.size(), meshes[0].tetrahedra.size());
}
