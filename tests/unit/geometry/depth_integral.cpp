// The depth of one body in another: compared with sums over the pieces that are nearest to each face, and with differences.
#include "geometry/polyhedra/depth_integral.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <string>

namespace kaya {
namespace {

/// A convex body by the planes of its faces.
struct Body {
    std::vector<HalfSpace> faces;

    void add(const Vec3& normal, double reach) { faces.push_back({normal.normalized(), reach}); }
    void move(const Vec3& by) {
        for (HalfSpace& face : faces) face.reach += face.normal.dot(by);
    }
};

/// A large box to begin with.
ConvexClip box() {
    ConvexClip clip;
    for (int i = 0; i < 8; ++i) clip.add_vertex({i & 1 ? 9.0 : -9.0, i & 2 ? 9.0 : -9.0, i & 4 ? 9.0 : -9.0});
    constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& side : sides) {
        clip.begin_face();
        for (const int corner : side) clip.add_corner(corner);
    }
    return clip;
}

/// The common part of two bodies; the faces of the first are those of the subject.
ConvexClip common_part(const Body& one, const Body& two) {
    ConvexClip clip = box();
    for (const HalfSpace& face : one.faces) clip.clip(face, FaceOrigin::subject);
    for (const HalfSpace& face : two.faces) clip.clip(face, FaceOrigin::clipper);
    return clip;
}

/// The integral of the depth below a body, by the volume and the centroid of each piece.
double by_pieces(const ConvexClip& part, const std::vector<HalfSpace>& faces) {
    double sum = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        ConvexClip piece;
        piece.copy(part);
        for (std::size_t j = 0; j < faces.size() && !piece.empty(); ++j)
            if (j != i)
                piece.clip({faces[j].normal - faces[i].normal, faces[j].reach - faces[i].reach}, FaceOrigin::inner);
        if (piece.empty()) continue;
        const OverlapMoments moments = moments_of(piece);
        if (moments.volume > 0) sum += moments.volume * faces[i].depth(moments.centroid);
    }
    return sum;
}

Vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return Vec3(normal(random), normal(random), normal(random)).normalized();
}

/// Bodies of one kind, the second one as deep in the first as the last number says.
struct Kind {
    std::string name;
    Body (*make)(std::mt19937&);
    double deep;
};

Body stone(std::mt19937& random) {
    std::uniform_real_distribution<double> size(0.8, 1.2);
    Body body;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) body.add(sign * Vec3::Unit(axis), 1.3);
    for (int i = 0; i < 24; ++i) body.add(random_direction(random), size(random));
    return body;
}

/// A pyramid whose sides meet in one tip, upward.
Body pyramid(std::mt19937& random) {
    const int sides = 3 + static_cast<int>(random() % 8);
    std::uniform_real_distribution<double> steep(0.3, 2);
    const double rise = steep(random);
    Body body;
    body.add(-Vec3::UnitZ(), 1);
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        const Vec3 normal = Vec3(rise * std::cos(angle), rise * std::sin(angle), 1).normalized();
        body.add(normal, normal.z());
    }
    return body;
}

/// A plate between two faces, nearly or exactly parallel.
Body plate(std::mt19937& random) {
    std::uniform_real_distribution<double> tilt(-1e-4, 1e-4);
    Body body;
    const bool parallel = random() % 2 == 0;
    body.add(Vec3(parallel ? 0 : tilt(random), 0, 1), 0.02);
    body.add(-Vec3::UnitZ(), 0.02);
    for (int axis = 0; axis < 2; ++axis)
        for (const double sign : {-1.0, 1.0}) body.add(sign * Vec3::Unit(axis), 1);
    return body;
}

/// A roof of faces that are nearly in one plane, some of them twice.
Body dome(std::mt19937& random) {
    std::uniform_real_distribution<double> tilt(-1e-3, 1e-3), high(1, 1 + 1e-5);
    Body body;
    for (int i = 0; i < 6; ++i) {
        body.add(Vec3(tilt(random), tilt(random), 1), high(random));
        if (i % 2 == 0) body.faces.push_back(body.faces.back());
    }
    body.add(-Vec3::UnitZ(), 1);
    for (int axis = 0; axis < 2; ++axis)
        for (const double sign : {-1.0, 1.0}) body.add(sign * Vec3::Unit(axis), 1);
    return body;
}

Body cube(std::mt19937&) {
    Body body;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) body.add(sign * Vec3::Unit(axis), 1);
    return body;
}

/// A roof with a long ridge between two gables, which lean a little; its common part with a plate is a strip with two ends.
Body ridge(std::mt19937& random) {
    std::uniform_real_distribution<double> steep(0.1, 2), lean(-0.1, 0.1);
    Body body;
    for (const double sign : {-1.0, 1.0}) {
        body.add(Vec3(sign * steep(random), 0, 1), 0.5);
        body.add(Vec3(lean(random), sign, lean(random)), 2);
    }
    body.add(-Vec3::UnitZ(), 0.5);
    return body;
}

Body turned(Body body, std::mt19937& random) {
    std::uniform_real_distribution<double> angle(-3, 3);
    const Mat3 turn = Eigen::AngleAxisd(angle(random), random_direction(random)).toRotationMatrix();
    for (HalfSpace& face : body.faces) face.normal = turn * face.normal;
    return body;
}

/// A pair that overlaps: the second body is moved from afar toward the first until it is `deep` in it along a random direction.
std::pair<Body, Body> overlapping(const Kind& first, const Kind& second, double deep, std::mt19937& random) {
    Body one = turned(first.make(random), random), two = turned(second.make(random), random);
    const Vec3 way = random_direction(random);
    double apart = 6, inside = 0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (apart + inside);
        Body moved = two;
        moved.move(middle * way);
        (common_part(one, moved).empty() ? apart : inside) = middle;
    }
    two.move((inside - deep) * way);
    return {one, two};
}

const Kind kinds[] = {{"stones", stone, 0.1}, {"pyramids", pyramid, 0.05}, {"plates", plate, 0.01},
                      {"domes", dome, 1e-4},  {"cubes", cube, 1e-5},       {"ridges", ridge, 0.01}};

/// A ridge along the top of a cube, a little askew, in the cube by `deep`.
std::pair<Body, Body> ridge_on_top(double deep, std::mt19937& random) {
    std::uniform_real_distribution<double> askew(-1e-4, 1e-4), turn(-1, 1);
    const Mat3 over = Eigen::AngleAxisd(std::numbers::pi + askew(random), Vec3::UnitX()).toRotationMatrix() *
                      Eigen::AngleAxisd(turn(random), Vec3::UnitZ()).toRotationMatrix();
    Body one = cube(random), two = ridge(random);
    for (HalfSpace& face : two.faces) face.normal = over * face.normal;
    double high = 3, low = 0; // of the second body
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (high + low);
        Body moved = two;
        moved.move(middle * Vec3::UnitZ());
        (common_part(one, moved).empty() ? high : low) = middle;
    }
    two.move((low - deep) * Vec3::UnitZ());
    return {one, two};
}

/// Compares the integrals of the depths below both bodies with sums over pieces and with differences, `deep` being the size of the common part.
void check(const Body& one, const Body& two, double deep, const std::string& name, std::mt19937& random) {
    DepthScratch scratch;
    const ConvexClip part = common_part(one, two);
    ASSERT_FALSE(part.empty());
    for (const bool of_subject : {true, false}) {
        SCOPED_TRACE(name + (of_subject ? ", of the first" : ", of the second"));
        const std::vector<HalfSpace>& faces = of_subject ? one.faces : two.faces;
        const OverlapGradient depth = depth_gradient(part, faces, of_subject, false, scratch);
        std::vector<HalfSpace> once; // the pieces of two faces in one plane would count twice
        for (const HalfSpace& face : faces)
            if (std::none_of(once.begin(), once.end(), [&](const HalfSpace& other) {
                    return other.normal == face.normal && other.reach == face.reach;
                }))
                once.push_back(face);
        const double exact = by_pieces(part, once);
        // Depths follow from coordinates of some lengths.
        const double rounding = 3e-14 * moments_of(part).volume + 1e-11 * exact;
        EXPECT_NEAR(depth.value, exact, rounding);
        // The faces in another order.
        std::vector<HalfSpace> mixed = faces;
        std::shuffle(mixed.begin(), mixed.end(), random);
        const OverlapGradient again = depth_gradient(part, mixed, of_subject, false, scratch);
        EXPECT_NEAR(again.value, depth.value, rounding);
        EXPECT_LT((again.force - depth.force).norm(), 1e-9 * depth.force.norm());
        EXPECT_LT((again.moment - depth.moment).norm(), 1e-9 * (depth.force.norm() + depth.moment.norm()));
        // The force is minus the change of the integral as the second body moves.
        const Vec3 along = depth.force.normalized();
        const double step = 1e-4 * deep;
        const auto moved = [&](double by) {
            Body there = two;
            there.move(by * along);
            return depth_gradient(common_part(one, there), of_subject ? one.faces : there.faces, of_subject, false,
                                  scratch)
                .value;
        };
        EXPECT_NEAR(depth.force.norm(), (moved(-step) - moved(step)) / (2 * step), 1e-5 * depth.force.norm());
    }
}

class DepthIntegrals : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(DepthIntegrals, AreTheSumOverPiecesAndHaveTheirGradient) {
    const Kind &first = kinds[std::get<0>(GetParam())], &second = kinds[std::get<1>(GetParam())];
    const double deep = std::min(first.deep, second.deep);
    for (unsigned seed = 1; seed <= 40; ++seed) {
        std::mt19937 random(seed);
        const auto [one, two] = overlapping(first, second, deep, random);
        check(one, two, deep, first.name + " and " + second.name + ", seed " + std::to_string(seed), random);
    }
}

TEST(DepthIntegral, OfStripsIsTheSumOverPiecesToo) {
    for (const double deep : {1e-2, 1e-3, 1e-4})
        for (unsigned seed = 1; seed <= 100; ++seed) {
            std::mt19937 random(seed);
            const auto [one, two] = ridge_on_top(deep, random);
            check(one, two, deep, "ridge of depth " + std::to_string(deep) + ", seed " + std::to_string(seed), random);
        }
}

INSTANTIATE_TEST_SUITE_P(Kinds, DepthIntegrals, testing::Combine(testing::Range(0, 6), testing::Range(0, 6)));

} // namespace
} // namespace kaya
