// Overlapping faces: the wedge over a polygon compared with the clip of whole bodies, and its gradient.
#include "geometry/overlay/flat_overlap.hpp"
#include "geometry/polyhedra/depth_integral.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace kaya {
namespace {

/// A polygon on an ellipse in the plane z = 0, anticlockwise from above.
std::vector<Vec3> random_polygon(std::mt19937& random) {
    std::uniform_real_distribution<double> part(0, 1);
    const int corners = 3 + static_cast<int>(5 * part(random));
    const double a = 0.5 + part(random), b = 0.5 + part(random), begin = part(random), x = 0.4 * part(random),
                 y = 0.4 * part(random);
    std::vector<Vec3> polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * (begin + i + 0.4 * part(random)) / corners;
        polygon.emplace_back(x + a * std::cos(angle), y + b * std::sin(angle), 0);
    }
    return polygon;
}

/// Block 1 below a plane, block 2 above it, slightly rotated and overlapping; both in rotated axes.
struct Case {
    ConvexFace one, two;
    Mat3 axes;

    explicit Case(unsigned seed, double tilt) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> part(-1, 1);
        one = {random_polygon(random), Vec3::UnitZ()};
        two = {random_polygon(random), -Vec3::UnitZ()};
        std::reverse(two.corners.begin(), two.corners.end());
        const Vec3 turn(tilt * part(random), tilt * part(random), part(random));
        move(two, Vec3(0.2 * part(random), 0.2 * part(random), 0.3 * tilt * part(random)), turn);
        axes =
            Eigen::Quaterniond(part(random), part(random), part(random), part(random)).normalized().toRotationMatrix();
        for (ConvexFace* face : {&one, &two}) move(*face, axes * Vec3(0.3, -0.2, 0.1), axes);
    }
    static void move(ConvexFace& face, const Vec3& way, const Mat3& turn) {
        for (Vec3& x : face.corners) x = way + turn * x;
        face.outward = turn * face.outward;
    }
    static void move(ConvexFace& face, const Vec3& way, const Vec3& turn) {
        move(face, way,
             turn.norm() > 0 ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()
                             : Mat3(Mat3::Identity()));
    }
};

/// The body behind a face, half a length thick.
void add_slab(ConvexClip& clip, const ConvexFace& face, const Vec3& upright) {
    const int n = static_cast<int>(face.corners.size());
    for (const Vec3& x : face.corners) clip.add_vertex(x);
    for (const Vec3& x : face.corners) clip.add_vertex(x - 0.5 * upright);
    clip.begin_face();
    for (int i = 0; i < n; ++i) clip.add_corner(i);
    clip.begin_face();
    for (int i = n; i-- > 0;) clip.add_corner(n + i);
    for (int i = 0; i < n; ++i) {
        clip.begin_face();
        for (const int corner : {i, n + i, n + (i + 1) % n, (i + 1) % n}) clip.add_corner(corner);
    }
}

class FlatOverlaps : public testing::TestWithParam<unsigned> {};

TEST_P(FlatOverlaps, AgreeWithTheClipOfTheBodies) {
    const Case c(GetParam(), 1e-4);
    FlatOverlap flat;
    const bool found = flat.find(c.one, c.two);
    const Vec3 upright = (c.one.outward - c.two.outward).normalized();
    ConvexClip clip, other;
    add_slab(clip, c.one, upright);
    add_slab(other, c.two, -upright);
    for (std::size_t f = 0; f < other.face_count() && !clip.empty(); ++f) {
        const Vec3 outward = other.area_vector(f).normalized();
        clip.clip({outward, outward.dot(other.corner(f, 0))}, FaceOrigin::clipper);
    }
    const OverlapMoments exact = moments_of(clip);
    ASSERT_EQ(found, exact.volume > 0);
    if (!found) return;
    EXPECT_NEAR(flat.moments().volume, exact.volume, 1e-6 * exact.volume);
    EXPECT_LT((flat.moments().centroid - exact.centroid).norm(), 1e-5);
    EXPECT_LT((flat.moments().second - exact.second).norm(), 1e-5);
    DepthScratch scratch;
    for (const bool of_subject : {true, false}) {
        const ConvexFace& face = of_subject ? c.one : c.two;
        const std::vector<HalfSpace> faces{{face.outward, face.outward.dot(face.corners[0])}};
        const OverlapGradient depth = depth_gradient(clip, faces, of_subject, false, scratch);
        EXPECT_NEAR(flat.depth().value, depth.value, 1e-5 * depth.value);
        EXPECT_LT((flat.depth().force - depth.force).norm(), 1e-4 * depth.force.norm());
        EXPECT_LT((flat.depth().moment - depth.moment).norm(), 1e-4 * depth.force.norm());
    }
}

TEST_P(FlatOverlaps, PushAsTheirEnergyChanges) {
    const Case c(GetParam(), 1e-4);
    FlatOverlap flat;
    if (!flat.find(c.one, c.two)) return;
    const OverlapGradient volume = flat.volume(), depth = flat.depth();
    const double deepest = flat.deepest_below();
    constexpr double step = 1e-7;
    for (int k = 0; k < 6; ++k) {
        double volumes[2], depths[2];
        for (const int side : {0, 1}) {
            Vec3 way = Vec3::Zero(), turn = Vec3::Zero();
            (k < 3 ? way : turn)[k % 3] = side == 0 ? -step : step;
            ConvexFace moved = c.two;
            Case::move(moved, way, turn);
            flat.find(c.one, moved);
            volumes[side] = flat.volume().value;
            depths[side] = flat.depth().value;
        }
        const double of_volume = k < 3 ? volume.force[k] : volume.moment[k - 3],
                     of_depth = k < 3 ? depth.force[k] : depth.moment[k - 3];
        // The omitted term is of the order of the closure over the size.
        EXPECT_NEAR((volumes[0] - volumes[1]) / (2 * step), of_volume, 3e-3 * volume.force.norm()) << k;
        EXPECT_NEAR((depths[0] - depths[1]) / (2 * step), of_depth,
                    3e-3 * depth.force.norm() + 3 * step * step / deepest)
            << k;
    }
}

INSTANTIATE_TEST_SUITE_P(random, FlatOverlaps, testing::Range(1u, 60u));

} // namespace
} // namespace kaya
