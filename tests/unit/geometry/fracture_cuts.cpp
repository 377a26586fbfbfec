#include "geometry/fractures/fracture_cuts.hpp"

#include "base/diagnostic.hpp"
#include "geometry/fractures/growth.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "geometry/surface/block_cuts.hpp"
#include "geometry/surface/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

using namespace kaya;

namespace {

Fracture disc(const Vec3& centre, double dip, double dip_direction, double diameter, int joint_set = 1) {
    Fracture fracture{{centre, dip, dip_direction, diameter}};
    fracture.joint_set = joint_set;
    return fracture;
}

double volume_of(const CutBlocks& cut) {
    double sum = 0;
    for (const auto& piece : cut.pieces) sum += mass_properties(piece.polyhedron).volume;
    return sum;
}

/// Of one side of the faces that the test picks.
template <class Picks> double area_of_faces(const CutBlocks& cut, Picks picks) {
    double sum = 0;
    for (const auto& piece : cut.pieces)
        for (const auto& face : piece.polyhedron.faces) {
            if (!picks(face)) continue;
            std::vector<Vec3> corners;
            for (const int v : face.vertices) corners.push_back(piece.polyhedron.vertices[static_cast<std::size_t>(v)]);
            sum += 0.5 * area_vector(corners).norm();
        }
    return sum;
}
constexpr auto is_open = [](const Polyhedron::Face& face) { return face.open; };

/// Bodies of the pieces when they are joined where no open face is between them.
std::size_t bodies_of(const CutBlocks& cut, double near) {
    std::vector<std::size_t> root(cut.pieces.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
        while (root[i] != i) i = root[i];
        return i;
    };
    for (std::size_t i = 0; i < root.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (cut.pieces[i].parent == cut.pieces[j].parent &&
                faces_in_contact(cut.pieces[i].polyhedron, cut.pieces[j].polyhedron, near))
                root[find(i)] = find(j);
    std::size_t bodies = 0;
    for (std::size_t i = 0; i < root.size(); ++i) bodies += root[i] == i;
    return bodies;
}

FractureCutting limited(int sides = 12) {
    FractureCutting how;
    how.limited = true;
    how.sides = sides;
    return how;
}

/// Length units, places and turns about z, with a mirror: what the areas must not depend on.
struct Motion {
    double scale, turn;
    Vec3 shift;
    bool mirrored;
    Vec3 operator()(const Vec3& x) const {
        const Vec3 seen = mirrored ? Vec3(-x.x(), x.y(), x.z()) : x;
        return scale * (Eigen::AngleAxisd(turn * std::numbers::pi / 180, Vec3::UnitZ()) * seen) + shift;
    }
    Fracture operator()(const Fracture& f) const {
        const double dd = (mirrored ? -f.disc.dip_direction : f.disc.dip_direction) - turn;
        return disc((*this)(f.disc.centre), f.disc.dip, dd, scale * f.disc.diameter, f.joint_set);
    }
    Polyhedron operator()(Polyhedron p) const {
        for (Vec3& v : p.vertices) v = (*this)(v);
        if (mirrored)
            for (auto& face : p.faces) std::ranges::reverse(face.vertices);
        return p;
    }
};
const std::vector<Motion> motions{{1, 0, {0, 0, 0}, false},     {1, 37, {0, 0, 0}, false},
                                  {1, 90, {5, -3, 2}, true},    {1, 0, {1e6, -2e6, 5e5}, false},
                                  {1e3, 20, {0, 0, 0}, true},   {1e-3, 300, {0, 0, 0}, false},
                                  {1e-3, 0, {-7, 11, 3}, false}};

} // namespace

TEST(FractureCuts, JointsHaveTheAreaOfDiscsThatEndInABlock) {
    for (const Motion& motion : motions)
        for (const int sides : {3, 4, 8, 12, 33}) {
            const std::vector<Polyhedron> rock{motion(make_brick({0, 0, 0}, {10, 10, 10}))};
            const std::vector<Fracture> discs{
                motion(disc({3, 3, 3}, 35, 120, 2, 1)), motion(disc({7, 6, 5}, 80, 300, 3, 2)),
                motion(disc({3, 7, 8}, 0, 0, 1, 3)), motion(disc({7, 3, 8}, 90, 45, 2, 4))};
            const FractureCuts cut = cut_by_fractures(rock, discs, limited(sides));
            const double area = std::numbers::pi / 4 * (4 + 9 + 1 + 4) * motion.scale * motion.scale;
            // Coordinates round at 1e-16 of their size.
            const double share = 1e-9 + 1e-14 * motion.shift.norm() / motion.scale;
            EXPECT_NEAR(cut.of_fractures, area, share * area);
            EXPECT_NEAR(cut.of_joints, area, share * area) << sides;
            EXPECT_NEAR(area_of_faces(cut.blocks, is_open), area, share * area);
            EXPECT_NEAR(volume_of(cut.blocks), 1000 * std::pow(motion.scale, 3),
                        1e-9 * 1000 * std::pow(motion.scale, 3) + share * 1000 * std::pow(motion.scale, 3));
            EXPECT_EQ(bodies_of(cut.blocks, 1e-3 * motion.scale), 1u); // no disc reaches a side
            EXPECT_EQ(cut.blocks.slivers + cut.blocks.corners, 0);
        }
}

/// Discs anywhere, through each other and through the sides: the joints are the polygons inside of the block.
TEST(FractureCuts, JointsOfRandomDiscsAreTheirPolygons) {
    FractureLaw law;
    law.size = FractureLaw::Size::uniform;
    law.sizes = {1, 9};
    Growth growth;
    growth.high = Vec3::Constant(10);
    growth.target = 12;
    for (int trial = 0; trial < 25; ++trial) {
        std::vector<Fracture> discs;
        for (const Disc& d : grow(law, growth, Random(100 + static_cast<std::uint64_t>(trial))))
            discs.push_back(disc(d.centre, d.dip, d.dip_direction, d.diameter, static_cast<int>(discs.size()) + 1));
        const std::vector<Polyhedron> rock{make_brick({0, 0, 0}, {10, 10, 4}), make_brick({0, 0, 4}, {10, 10, 10})};
        const FractureCuts cut = cut_by_fractures(rock, discs, limited());
        double polygons = 0, exact = 0;
        for (const Fracture& f : discs) {
            const double part = area_in_box(polygon_fracture(outline_of(f, 12)), Vec3::Zero(), Vec3::Constant(10));
            polygons += part;
            exact += area_in_box(f, Vec3::Zero(), Vec3::Constant(10));
            EXPECT_NEAR(
                area_of_faces(cut.blocks, [&](const auto& face) { return face.open && face.joint_set == f.joint_set; }),
                part, 1e-9 * part)
                << trial;
        }
        EXPECT_NEAR(cut.of_joints, polygons, 1e-9 * polygons);
        EXPECT_NEAR(cut.of_fractures, exact, 1e-9 * exact);
        EXPECT_NEAR(polygons, exact,
                    0.02 * exact); // a disc that ends in the air: 12 sides are 2.3 % wide of the rim at most
        EXPECT_NEAR(volume_of(cut.blocks), 1000, 1e-9);
    }
}

TEST(FractureCuts, DiscsWiderThanTheRockCutAsAJointSet) {
    Random random(23);
    const std::vector<Polyhedron> rock{make_brick({0, 0, 0}, {10, 10, 10}), make_brick({10, 0, 0}, {20, 10, 10})};
    for (int trial = 0; trial < 40; ++trial) {
        JointSet set;
        set.dip = 90 * random.uniform();
        set.dip_direction = 360 * random.uniform();
        set.spacing = 0.8 + random.uniform();
        set.number = 7;
        set.origin = {5 + random.uniform(), 5, 5};
        set.id = 3;
        std::vector<Fracture> discs;
        const Vec3 normal = normal_from_dip(set.dip, set.dip_direction);
        for (int i = 0; i < set.number; ++i) { // the order of a joint set: 0, 1, -1, 2, -2, ...
            const double place = (i % 2 ? (i + 1) / 2 : -(i / 2)) * set.spacing;
            discs.push_back(disc(set.origin + place * normal, set.dip, set.dip_direction, 1000, 3));
        }
        const CutBlocks by_set = cut_blocks(rock, set);
        ASSERT_GT(by_set.pieces.size(), rock.size());
        for (const bool ends : {false, true}) {
            const CutBlocks by_discs = cut_by_fractures(rock, discs, ends ? limited() : FractureCutting{}).blocks;
            ASSERT_EQ(by_set.pieces.size(), by_discs.pieces.size()) << trial;
            for (std::size_t i = 0; i < by_set.pieces.size(); ++i) {
                EXPECT_EQ(by_set.pieces[i].parent, by_discs.pieces[i].parent);
                EXPECT_EQ(by_set.pieces[i].polyhedron.vertices, by_discs.pieces[i].polyhedron.vertices);
            }
            EXPECT_EQ(bodies_of(by_discs, 1e-3), ends ? by_discs.pieces.size() : 2);
        }
    }
}

/// Three sets at right angles cut a cube of edge 4 into 64 cubes, also by discs that end outside of it.
TEST(FractureCuts, ThreeSetsCutACubeIntoCubes) {
    for (const double diameter : {5.7, 8.0, 100.0}) { // the diagonal of a side is 5.66
        std::vector<Fracture> discs;
        for (int k = 1; k < 4; ++k) {
            discs.push_back(disc({2, 2, 1.0 * k}, 0, 0, diameter, 1));
            discs.push_back(disc({1.0 * k, 2, 2}, 90, 90, diameter, 2));
            discs.push_back(disc({2, 1.0 * k, 2}, 90, 0, diameter, 3));
        }
        for (const FractureCutting& how : {FractureCutting{}, limited(diameter < 8 ? 64 : 12)}) {
            const FractureCuts cut = cut_by_fractures({make_brick({0, 0, 0}, {4, 4, 4})}, discs, how);
            EXPECT_EQ(cut.blocks.pieces.size(), 64u) << diameter;
            EXPECT_NEAR(cut.of_joints, 9 * 16, 1e-9);
            EXPECT_NEAR(cut.of_fractures, 9 * 16, 1e-9);
            EXPECT_EQ(bodies_of(cut.blocks, 1e-3), how.limited ? 64u : 1u);
        }
    }
}

/// Six discs around a cube in the middle, 0.2 beyond its corners, make it a separate body; smaller ones leave bridges.
TEST(FractureCuts, DiscsThatEncloseAPartCutItOut) {
    for (const bool closed : {true, false}) {
        std::vector<Fracture> discs;
        const double diameter = closed ? 2 * std::sqrt(2.0) + 0.4 : 2 * std::sqrt(2.0) - 0.4;
        for (int k = 0; k < 3; ++k)
            for (const double side : {-1.0, 1.0}) {
                Vec3 centre = Vec3::Constant(5);
                centre[k] += side;
                discs.push_back(disc(centre, k == 2 ? 0 : 90, k == 0 ? 90 : 0, diameter, 1));
            }
        const FractureCuts cut = cut_by_fractures({make_brick({0, 0, 0}, {10, 10, 10})}, discs, limited(16));
        EXPECT_NEAR(cut.of_joints, 6 * std::numbers::pi / 4 * diameter * diameter, 1e-9 * cut.of_joints);
        EXPECT_EQ(bodies_of(cut.blocks, 1e-3), closed ? 2u : 1u);
    }
}

TEST(FractureCuts, OnlyBlocksThatTheDiscReachesAreCut) {
    const std::vector<Polyhedron> rock{make_brick({0, 0, 0}, {1, 1, 1}), make_brick({1, 0, 0}, {2, 1, 1}),
                                       make_brick({2, 0, 0}, {3, 1, 1})};
    const auto cut = [&](double x, double diameter) {
        return cut_by_fractures(rock, {disc({x, 0.5, 0.5}, 0, 0, diameter)}, {}).blocks.parents;
    };
    EXPECT_EQ(cut(0.5, 0.5), (std::vector{0}));
    EXPECT_EQ(cut(0.5, 1), (std::vector{0}));         // touches the second
    EXPECT_EQ(cut(0.5, 1.0001), (std::vector{0, 1})); // reaches it with its rim alone
    EXPECT_EQ(cut(1.5, 1.1), (std::vector{0, 1, 2}));
    EXPECT_EQ(cut(5, 1), std::vector<int>{});
    EXPECT_EQ(cut_by_fractures(rock, {disc({0.5, 0.5, 1}, 0, 0, 9)}, limited()).of_fractures, 0); // in the faces
}

TEST(FractureCuts, PersistenceIsAShareOfTheArea) {
    const Polyhedron brick = make_brick({0, 0, 0}, {1, 1, 1});
    const std::vector<Polyhedron> rock(10'000, brick);
    FractureCutting how;
    for (const double p : {0.0, 0.3, 1.0}) {
        how.persistence = p;
        const FractureCuts cut = cut_by_fractures(rock, {disc({0.5, 0.5, 0.5}, 0, 0, 9)}, how);
        EXPECT_NEAR(cut.of_joints / cut.of_fractures, p, 4.9 * std::sqrt(p * (1 - p) / 10'000)); // once in a million
    }
    how.persistence = 0.3;
    const auto first = cut_by_fractures(rock, {disc({0.5, 0.5, 0.5}, 0, 0, 9)}, how).blocks.parents;
    EXPECT_EQ(first, cut_by_fractures(rock, {disc({0.5, 0.5, 0.5}, 0, 0, 9)}, how).blocks.parents);
    how.seed = 1;
    EXPECT_NE(first, cut_by_fractures(rock, {disc({0.5, 0.5, 0.5}, 0, 0, 9)}, how).blocks.parents);
}

TEST(FractureCuts, SmallPiecesAreNotMade) {
    FractureCutting how = limited();
    how.nearest = 0.05;
    // The second plane would leave a plate of 0.01.
    const FractureCuts cut = cut_by_fractures({make_brick({0, 0, 0}, {1, 1, 1})},
                                              {disc({0.5, 0.5, 0.5}, 0, 0, 9), disc({0.5, 0.5, 0.51}, 0, 0, 9)}, how);
    EXPECT_EQ(cut.blocks.pieces.size(), 2u);
    EXPECT_EQ(cut.blocks.corners, 1);
}

TEST(FractureCuts, PolygonsCutAsDiscsDo) {
    Fracture square = polygon_fracture({{3, 3, 5}, {3, 6, 5}, {6, 6, 5}, {6, 3, 5}}); // clockwise from above
    EXPECT_NEAR(area_of(square), 9, 1e-14);
    EXPECT_TRUE(square.disc.centre.isApprox(Vec3(4.5, 4.5, 5)));
    EXPECT_EQ(square.disc.dip, 0);
    square.joint_set = 7;
    const FractureCuts cut = cut_by_fractures({make_brick({0, 0, 0}, {10, 10, 10})}, {square}, limited());
    EXPECT_NEAR(cut.of_joints, 9, 1e-12);
    EXPECT_NEAR(cut.of_fractures, 9, 1e-12);
    EXPECT_EQ(cut.blocks.pieces.size(), 6u);
    EXPECT_NEAR(distance_to(square, {4, 4, 7}), 2, 1e-14);
    EXPECT_NEAR(distance_to(square, {0, 4, 9}), 5, 1e-14);
    EXPECT_NEAR(distance_to(square, {9, 10, 5}), 5, 1e-14);
    EXPECT_NEAR(distance_to(disc({1, 1, 1}, 0, 0, 2), {1, 5, 5}), 5, 1e-14);
    EXPECT_NEAR(distance_to(disc({1, 1, 1}, 0, 0, 2), {1, 1.5, 3}), 2, 1e-14);
    EXPECT_TRUE(crosses(square, {4, 4, 0}, {4, 4, 9}));
    EXPECT_FALSE(crosses(square, {2, 4, 0}, {2, 4, 9}));
    EXPECT_NEAR(area_in_box(square, {0, 0, 0}, {4, 4, 9}), 1, 1e-14);
    const auto message = [](const std::vector<Vec3>& corners) {
        try {
            polygon_fracture(corners);
        } catch (const Diagnostic& refused) { return refused.message; }
        return std::string("none");
    };
    EXPECT_EQ(message({{0, 0, 0}, {1, 0, 0}}), "a polygon has three corners or more, not 2");
    EXPECT_EQ(message({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), "the polygon has no area");
    EXPECT_EQ(message({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}}),
              "the corners of the polygon do not lie in one plane");
    EXPECT_EQ(message({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}), "the polygon is not convex");
    EXPECT_EQ(message({{0, 0, 0}, {1, 0, 0}, {1, std::nan(""), 0}}), "a corner of the polygon is not a finite number");
}
