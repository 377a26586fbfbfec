// Concave bodies by families: nothing is refused by chance, and the split depends on the shape alone.
#include "geometry/read/surface_files.hpp"

#include "base/diagnostic.hpp"
#include "closed.hpp"
#include "geometry/polyhedra/random.hpp"
#include "geometry/surface/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

using namespace kaya;
using kaya::test::closed;

namespace {

using Outline = std::vector<Eigen::Vector2d>;
using Loops = std::vector<std::vector<Vec3>>;

Outline star(int points, double inner) {
    Outline outline;
    for (int k = 0; k < 2 * points; ++k) {
        const double r = k % 2 == 0 ? 1 : inner, a = k * std::numbers::pi / points;
        outline.emplace_back(r * std::cos(a), r * std::sin(a));
    }
    return outline;
}

/// A comb with teeth of different lengths.
Outline comb(int teeth) {
    Outline outline{{0, 0}, {2.0 * teeth - 1, 0}};
    for (int k = teeth - 1; k >= 0; --k) {
        const double high = 2 + 0.3 * k;
        outline.emplace_back(2 * k + 1, high);
        outline.emplace_back(2 * k, high);
        if (k > 0) {
            outline.emplace_back(2 * k, 1);
            outline.emplace_back(2 * k - 1, 1);
        }
    }
    return outline;
}

const std::vector<Outline>& outlines() {
    static const std::vector<Outline> all{{{-0.2, -0.8},
                                           {0.2, -0.8},
                                           {0.2, -0.2},
                                           {0.8, -0.2},
                                           {0.8, 0.2},
                                           {0.2, 0.2},
                                           {0.2, 0.8},
                                           {-0.2, 0.8},
                                           {-0.2, 0.2},
                                           {-0.8, 0.2},
                                           {-0.8, -0.2},
                                           {-0.2, -0.2}},
                                          {{0, 0}, {1, 0}, {1, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}},
                                          {{0, 0}, {1, 0}, {1, 1}, {0.7, 1}, {0.7, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}},
                                          {{-0.45, -0.1},
                                           {0.45, -0.1},
                                           {0.45, 0.299},
                                           {0.149, 0.299},
                                           {0.149, 1},
                                           {-0.149, 1},
                                           {-0.149, 0.299},
                                           {-0.45, 0.299}},
                                          star(5, 0.4),
                                          star(9, 0.7),
                                          comb(4)};
    return all;
}

double area_of(const Outline& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return twice / 2;
}

struct Pose {
    Eigen::Quaterniond turn;
    Vec3 shift;
    double scale;

    explicit Pose(Random& random)
        : turn(Eigen::Vector4d(random.symmetric(), random.symmetric(), random.symmetric(), random.symmetric())
                   .normalized()),
          shift(3 * Vec3(random.symmetric(), random.symmetric(), random.symmetric())),
          scale(std::pow(10, 3 * random.symmetric())) {
        shift *= scale;
    }
    Vec3 operator()(const Vec3& v) const { return scale * (turn * v) + shift; }
};

/// The two ends and the sides of a prism of height 0.4.
Loops prism_of(const Outline& outline, const Pose& pose) {
    Loops loops(2);
    for (const auto& p : outline) {
        loops[0].push_back(pose({p.x(), p.y(), -0.2}));
        loops[1].push_back(pose({p.x(), p.y(), 0.2}));
    }
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t j = (i + 1) % outline.size();
        loops.push_back({loops[0][i], loops[0][j], loops[1][j], loops[1][i]});
    }
    return loops;
}

double volume_of(const std::vector<Polyhedron>& parts) {
    double volume = 0;
    for (const Polyhedron& part : parts) {
        EXPECT_TRUE(closed(part));
        volume += mass_properties(part).volume;
    }
    return volume;
}

double volume_of(const SurfaceFile& file) {
    double volume = 0;
    for (const NamedSurface& body : file.surfaces)
        volume += volume_of(solid_from_surface(body.surface, {1e-3, true}, body.cavities).parts);
    return volume;
}

Loops box(const Vec3& low, const Vec3& high) {
    const Polyhedron brick = make_brick(low, high);
    Loops loops;
    for (const auto& face : brick.faces) {
        loops.emplace_back();
        for (const int v : face.vertices) loops.back().push_back(brick.vertices[v]);
    }
    return loops;
}

void append(Loops& all, const Loops& more) { all.insert(all.end(), more.begin(), more.end()); }

/// Faces in another order, with other first corners, some in the other direction.
void shuffle(Loops& loops, Random& random, bool directions) {
    for (std::size_t i = loops.size(); i > 1; --i) std::swap(loops[i - 1], loops[random.bits() % i]);
    for (auto& loop : loops) {
        std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.bits() % loop.size()), loop.end());
        if (directions && random.bits() % 2) std::reverse(loop.begin(), loop.end());
    }
}

/// Each face as two triangles, along either diagonal.
Loops triangulated(const Loops& loops, Random& random) {
    Loops triangles;
    for (auto loop : loops) {
        if (random.bits() % 2) std::rotate(loop.begin(), loop.begin() + 1, loop.end());
        triangles.push_back({loop[0], loop[1], loop[2]});
        triangles.push_back({loop[0], loop[2], loop[3]});
    }
    return triangles;
}

} // namespace

TEST(Concave, PrismsAreTakenInAThousandPoses) {
    Random random(41);
    std::size_t most_parts = 0;
    for (int k = 0; k < 1000; ++k) {
        const Outline& outline = outlines()[static_cast<std::size_t>(k) % outlines().size()];
        const Pose pose(random);
        const Loops loops = prism_of(outline, pose);
        const Solid solid = make_prism(loops[0], loops[1]);
        const double wanted = 0.4 * area_of(outline) * std::pow(pose.scale, 3);
        ASSERT_NEAR(volume_of(solid.parts), wanted, 1e-9 * wanted) << k;
        most_parts = std::max(most_parts, solid.parts.size());
    }
    EXPECT_LE(most_parts, 12u);
}

TEST(Concave, TheSplitDoesNotDependOnTheOrderOfFacesAndCorners) {
    Random random(42);
    for (int k = 0; k < 60; ++k) {
        const Outline& outline = outlines()[static_cast<std::size_t>(k) % outlines().size()];
        Loops loops = prism_of(outline, Pose(random));
        const Solid first = make_from_faces(loops);
        for (int trial = 0; trial < 4; ++trial) {
            shuffle(loops, random, true);
            const Solid other = make_from_faces(loops);
            ASSERT_EQ(other.parts.size(), first.parts.size()) << k;
            for (std::size_t p = 0; p < first.parts.size(); ++p)
                ASSERT_EQ(other.parts[p].vertices, first.parts[p].vertices) << k << ' ' << trial;
        }
    }
}

// A row of boxes that were joined in a modeller: each wall between two is there twice, in one piece or as different triangles.
TEST(Concave, InnerWallsOfJoinedMeshesAreDropped) {
    Random random(43);
    for (int k = 0; k < 60; ++k) {
        const Pose pose(random);
        FaceSoup soup;
        double wanted = 0, x = 0;
        const int boxes = 2 + k % 3;
        for (int i = 0; i < boxes; ++i) {
            const double length = 0.2 + random.uniform();
            // Every other family has boxes of different heights: the wall is the lower one's.
            append(soup.loops, box({x, 0, 0}, {x + length, 0.5, 0.3}));
            x += length;
            wanted += 0.15 * length;
        }
        for (auto& loop : soup.loops)
            for (Vec3& v : loop) v = pose(v);
        if (k % 2) soup.loops = triangulated(soup.loops, random);
        shuffle(soup.loops, random, k % 4 > 1);
        const SurfaceFile file = surfaces_of({soup});
        ASSERT_EQ(file.surfaces.size(), 1u) << k;
        EXPECT_EQ(file.repaired.doubled, (k % 2 ? 4 : 2) * (boxes - 1)) << k;
        const Solid solid = solid_from_surface(file.surfaces[0].surface, {1e-3, true});
        EXPECT_EQ(solid.parts.size(), 1u) << k;
        wanted *= std::pow(pose.scale, 3);
        EXPECT_NEAR(volume_of(solid.parts), wanted, 1e-6 * wanted) << k;
    }
}

TEST(Concave, AFaceThatIsThereTwiceIsTakenOnce) {
    Random random(44);
    for (std::size_t doubled = 0; doubled < 6; ++doubled) {
        FaceSoup soup{"brick", box({0, 0, 0}, {1, 2, 3})};
        soup.loops.push_back(soup.loops[doubled]);
        shuffle(soup.loops, random, true);
        const SurfaceFile file = surfaces_of({soup});
        EXPECT_EQ(file.repaired.doubled, 1);
        EXPECT_NEAR(volume_of(file), 6, 1e-12);
    }
}

TEST(Concave, SurfacesInsideOthersAreHollows) {
    Random random(45);
    for (int k = 0; k < 20; ++k) {
        const Pose pose(random);
        FaceSoup soup;
        append(soup.loops, box({0, 0, 0}, {4, 4, 4}));
        append(soup.loops, box({0.5, 0.5, 0.5}, {1.5, 3, 3}));   // a hollow
        append(soup.loops, box({2, 0.5, 0.5}, {3.5, 3.5, 3.5})); // another one
        append(soup.loops, box({2.5, 1, 1}, {3, 2, 2}));         // a body in it
        append(soup.loops, box({4, 4, 4}, {5, 5, 5}));           // a neighbour that shares a corner
        append(soup.loops, box({-1, 0, 4}, {0, 4, 5}));          // and one that shares an edge
        for (auto& loop : soup.loops)
            for (Vec3& v : loop) v = pose(v);
        shuffle(soup.loops, random, true);
        const SurfaceFile file = surfaces_of({soup});
        EXPECT_EQ(file.surfaces.size(), 4u) << k;
        const double wanted = (64 - 6.25 - 13.5 + 0.5 + 1 + 4) * std::pow(pose.scale, 3);
        EXPECT_NEAR(volume_of(file), wanted, 1e-6 * wanted) << k;
    }
}

/// A plate of square cells with a hole in each cell whose row and column are both odd, as quadrilaterals.
Loops plate_with_holes(int holes, double thickness) {
    const int cells = 2 * holes + 1;
    const auto filled = [&](int i, int j) {
        return i >= 0 && j >= 0 && i < cells && j < cells && !(i % 2 == 1 && j % 2 == 1);
    };
    Loops loops;
    const auto wall = [&](const Vec3& a, const Vec3& b) {
        const Vec3 up(0, 0, thickness);
        loops.push_back({a, b, b + up, a + up});
    };
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            if (!filled(i, j)) continue;
            const Vec3 a(i, j, 0), b(i + 1, j, 0), c(i + 1, j + 1, 0), d(i, j + 1, 0), up(0, 0, thickness);
            loops.push_back({a, d, c, b});
            loops.push_back({a + up, b + up, c + up, d + up});
            if (!filled(i, j - 1)) wall(a, b);
            if (!filled(i + 1, j)) wall(b, c);
            if (!filled(i, j + 1)) wall(c, d);
            if (!filled(i - 1, j)) wall(d, a);
        }
    return loops;
}

TEST(Concave, BodiesMayHaveManyHoles) {
    Random random(48);
    for (int k = 0; k < 12; ++k) {
        const int holes = 1 + k % 4;
        const double thickness = 0.3 + 2 * random.uniform();
        const Pose pose(random);
        Loops loops = plate_with_holes(holes, thickness);
        for (auto& loop : loops)
            for (Vec3& v : loop) v = pose(v);
        shuffle(loops, random, true);
        const SurfaceFile file = surfaces_of({FaceSoup{{}, loops}});
        const double cells = (2 * holes + 1) * (2 * holes + 1) - holes * holes;
        const double wanted = cells * thickness * std::pow(pose.scale, 3);
        EXPECT_EQ(file.surfaces.size(), 1u) << k;
        EXPECT_NEAR(volume_of(file), wanted, 1e-6 * wanted) << k;
    }
}

// Thin saddles whose lower and upper faces have their lowest corners at different ends: the usual diagonals cross.
TEST(Concave, WarpedFacesAreDividedSoThatNothingCrosses) {
    Random random(46);
    for (int k = 0; k < 100; ++k) {
        const double thickness = 0.05 + 0.03 * random.uniform(), warp = 0.15 + 0.4 * random.uniform();
        const double skew = 0.02 + 0.1 * random.uniform();
        Loops loops{{{0, 0, warp}, {1, 0, 0}, {1, 1, warp}, {skew, 1, 0}},
                    {{skew, 0, warp}, {1, 0, 0}, {1, 1, warp}, {0, 1, 0}}};
        for (Vec3& v : loops[1]) v.z() += thickness;
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t j = (i + 1) % 4;
            loops.push_back({loops[0][i], loops[0][j], loops[1][j], loops[1][i]});
        }
        const Solid solid = make_from_faces(loops, {}, {1e-3, true});
        ASSERT_NEAR(volume_of(solid.parts), thickness, 0.2 * thickness) << k;
    }
}

// A corner of one face on an edge of another (a T-junction), as in cut and scanned stones.
TEST(Repair, CornersOnEdgesAreClosed) {
    Random random(47);
    for (int k = 0; k < 60; ++k) {
        const Pose pose(random);
        FaceSoup soup{"stone", box({0, 0, 0}, {1, 1, 1})};
        auto& top = soup.loops[1];
        // The top becomes two triangles fewer its neighbours' corner: an extra corner on one of its edges, a little off it.
        const Vec3 a = top[0], b = top[1];
        const double share = 0.2 + 0.6 * random.uniform();
        const Vec3 extra =
            a + share * (b - a) + 4e-4 * Vec3(random.symmetric(), random.symmetric(), random.symmetric());
        for (auto& loop : soup.loops) {
            if (&loop == &top) continue;
            for (std::size_t i = 0; i < loop.size(); ++i)
                if (loop[i] == b && loop[(i + 1) % loop.size()] == a) {
                    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, extra);
                    break;
                }
        }
        for (auto& loop : soup.loops)
            for (Vec3& v : loop) v = pose(v);
        const SurfaceFile as_it_is = surfaces_of({soup});
        EXPECT_THROW(solid_from_surface(as_it_is.surfaces[0].surface, {1e-3, true}), Diagnostic);
        const SurfaceFile file = surfaces_of({soup}, {1e-3 * pose.scale, 0});
        EXPECT_EQ(file.repaired.inserted, 1) << k;
        const double wanted = std::pow(pose.scale, 3);
        EXPECT_NEAR(volume_of(file), wanted, 1e-3 * wanted) << k;
    }
}

// Every face has its own corners, off by up to the tolerance: cracks along all edges.
TEST(Repair, CracksAreClosedByJoiningCorners) {
    Random random(48);
    for (int k = 0; k < 60; ++k) {
        const Pose pose(random);
        FaceSoup soup{"stone", triangulated(box({0, 0, 0}, {1, 2, 1.5}), random)};
        for (auto& loop : soup.loops)
            for (Vec3& v : loop) v = pose(v + 2e-4 * Vec3(random.symmetric(), random.symmetric(), random.symmetric()));
        const SurfaceFile file = surfaces_of({soup}, {1e-3 * pose.scale, 0});
        ASSERT_EQ(file.surfaces.size(), 1u) << k;
        EXPECT_GT(file.repaired.welded, 20) << k;
        const double wanted = 3 * std::pow(pose.scale, 3);
        EXPECT_NEAR(volume_of(file), wanted, 2e-3 * wanted) << k;
    }
}

TEST(Repair, HolesUpToAWidthAreClosed) {
    Random random(49);
    for (int k = 0; k < 30; ++k) {
        const Pose pose(random);
        FaceSoup soup{"stone", triangulated(box({0, 0, 0}, {1, 2, 1.5}), random)};
        for (auto& loop : soup.loops)
            for (Vec3& v : loop) v = pose(v);
        soup.loops.erase(soup.loops.begin() + static_cast<std::ptrdiff_t>(random.bits() % soup.loops.size()));
        EXPECT_THROW(volume_of(surfaces_of({soup}, {0, 0.5 * pose.scale})), Diagnostic) << k;
        const SurfaceFile file = surfaces_of({soup}, {0, 3 * pose.scale});
        EXPECT_EQ(file.repaired.closed, 1) << k;
        const double wanted = 3 * std::pow(pose.scale, 3);
        EXPECT_NEAR(volume_of(file), wanted, 1e-9 * wanted) << k;
    }
}
