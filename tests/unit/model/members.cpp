// Beams and liners in the tables of a model: positions of nodes, removed blocks, messages for damaged files.
#include "model/structures/members.hpp"

#include "model/whole/consistency.hpp"
#include "model/structures/lining.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

using namespace kaya;
using kaya::test::hand_made_model;

namespace {

/// A beam from a zone of the upper block to the outside, and a liner on the sloping faces of both blocks.
Model model_with_members() {
    Model model = hand_made_model();
    make_beam(model, {.places = {Vec3(0.1, 0.1, 0.1), Vec3(2, 0.1, 0.1)}, .segments = 3, .property = 2});
    double tolerance = 0;
    // The face opposite the origin is the third of each tetrahedron.
    Lining lining = line_triangles(model, triangles_to_line(model, {2, 6}, {}), 0.4, tolerance);
    make_liner(model, {.mesh = lining.mesh, .property = 3, .tolerance = tolerance});
    make_beam(model, {.places = {Vec3(3, 3, 3), Vec3(3, 3, 4), Vec3(3, 5, 4)}, .segments = 2, .property = 2});
    return model;
}

} // namespace

TEST(Members, LieInBlocksAndZonesOrOutside) {
    const Model model = model_with_members();
    const auto& nodes = model.structures.member_nodes;
    EXPECT_EQ(rock_block(model, nodes, 0), 0);
    EXPECT_EQ(nodes.zone[0], 0);
    EXPECT_LT((rock_place(model, nodes, 0) - Vec3(0.1, 0.1, 0.1)).norm(), 1e-14);
    EXPECT_EQ(rock_block(model, nodes, 3), no_row);
    EXPECT_NEAR(nodes.share[0], 1.9 / 6, 1e-12);
    EXPECT_NEAR(nodes.share[1], 1.9 / 3, 1e-12);
    const Span liner = model.structures.members.nodes[1];
    for (Row node = liner.first; node < liner.end(); ++node) {
        EXPECT_NE(rock_block(model, nodes, node), no_row);
        EXPECT_NEAR(nodes.normal[node].norm(), 1, 1e-12);
    }
    const Span corner = model.structures.members.nodes[2];
    EXPECT_EQ(corner.count, 5);
    EXPECT_EQ(nodes.reference[corner.first + 2], Vec3(3, 3, 4));
}

TEST(Members, LinersCoverFacesOnceAndShareTheirEdges) {
    const Model model = model_with_members();
    double area = 0, shares = 0;
    for (const auto& corners : model.structures.liners.nodes) {
        const auto at = [&](std::size_t k) { return model.structures.member_nodes.reference[corners[k]]; };
        area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
    }
    const Span nodes = model.structures.members.nodes[1];
    for (Row node = nodes.first; node < nodes.end(); ++node) shares += model.structures.member_nodes.share[node];
    EXPECT_NEAR(area, std::sqrt(3.0), 1e-12); // two triangles with sides of the root of 2
    EXPECT_NEAR(shares, area, 1e-12);
    const auto on_edge = [&](Row node) { return std::abs(model.structures.member_nodes.reference[node].z()) < 1e-12; };
    for (Row a = nodes.first; a < nodes.end(); ++a)
        for (Row b = nodes.first; b < a; ++b)
            if (on_edge(a) && on_edge(b)) {
                EXPECT_GT(
                    (model.structures.member_nodes.reference[a] - model.structures.member_nodes.reference[b]).norm(),
                    0.1);
            }
}

TEST(Members, AreTakenOutWithTheirRowsAndKeepTheirNumbers) {
    for (const std::vector<Row>& gone : {std::vector<Row>{0}, {1}, {2}, {0, 2}, {0, 1, 2}, {}}) {
        Model model = model_with_members();
        const Model before = model;
        delete_members(model, gone);
        EXPECT_EQ(inconsistency(model), "");
        std::size_t kept = 0;
        for (Row member = 0; member < 3; ++member) {
            const Row now = member_of_number(model, before.structures.members.number[member]);
            const bool taken = std::ranges::find(gone, member) != gone.end();
            EXPECT_EQ(now == no_row, taken);
            if (taken) continue;
            ++kept;
            const Span was = before.structures.members.nodes[member], is = model.structures.members.nodes[now];
            ASSERT_EQ(was.count, is.count);
            for (Row k = 0; k < was.count; ++k)
                EXPECT_EQ(before.structures.member_nodes.reference[was.first + k],
                          model.structures.member_nodes.reference[is.first + k]);
        }
        EXPECT_EQ(model.structures.members.size(), kept);
    }
}

TEST(Members, BeamsHaveAxesAcrossThemselvesWhereverTheyGo) {
    for (const Vec3& end : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1), Vec3(1, 2, 3), Vec3(1e-9, -1, 0)})
        for (const Vec3& wanted : {Vec3(0, 0, 0), Vec3(0, 5, 0), Vec3(0, 0, 1e-3), Vec3(1, 2, 3)}) {
            Model model;
            make_beam(model, {.places = {Vec3(7, 7, 7), Vec3(7, 7, 7) + end}, .segments = 1, .axis = wanted});
            const Vec3 y = model.structures.beams.axis_y[0];
            EXPECT_NEAR(y.norm(), 1, 1e-12);
            EXPECT_NEAR(y.dot(end) / end.norm(), 0, 1e-12);
            if (wanted.cross(end).norm() > 1e-3 * wanted.norm() * end.norm()) { EXPECT_GT(y.dot(wanted), 0); }
        }
}

TEST(Members, EveryDamageIsNamed) {
    struct Damage {
        std::function<void(Structures&)> change;
        const char* sentence;
    };
    const std::vector<Damage> damages{
        {[](Structures& s) { s.members.number[1] = 1; }, "row 1 of members: number 1"},
        {[](Structures& s) { s.members.kind[1] = 7; }, "row 1 of members: its kind is unknown"},
        {[](Structures& s) { s.members.kind[1] = beam_kind; }, "row 1 of members: its elements are not of its kind"},
        {[](Structures& s) { s.member_nodes.grip[0] = static_cast<Grip>(9); },
         "row 0 of member_nodes: its grip is unknown"},
        {[](Structures& s) { s.member_nodes.rotation[2] = Quaternion(0, 0, 0, 0); },
         "row 2 of member_nodes: its rotation is not a rotation"},
        {[](Structures& s) { s.member_nodes.zone[0] = 4; }, "row 0 of member_nodes: its block has no such zone"},
        {[](Structures& s) { s.beams.nodes[1][1] = 1; }, "row 1 of beams: it has no length"},
        {[](Structures& s) { s.beams.nodes[0][1] = 9; }, "row 0 of beams: node 9 is not one of its member"},
        {[](Structures& s) { s.liners.nodes[0][2] = -1; }, "row 0 of liners: node -1 is not one of its member"},
    };
    for (const auto& damage : damages) {
        Model model = model_with_members();
        EXPECT_EQ(inconsistency(model), "");
        damage.change(model.structures);
        EXPECT_EQ(inconsistency(model), damage.sentence);
    }
}
