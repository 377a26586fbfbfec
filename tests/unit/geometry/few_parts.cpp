// Concave bodies enclosed by few convex parts.
#include "geometry/surface/few_parts.hpp"

#include "closed.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/surface/shapes.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace kaya;
using kaya::test::closed;

namespace {

double volume_of_parts(const std::vector<Polyhedron>& parts) {
    double volume = 0;
    for (const Polyhedron& part : parts) {
        EXPECT_TRUE(closed(part));
        volume += mass_properties(part).volume;
    }
    return volume;
}

/// The volume that two convex bodies share.
double shared_volume(const Polyhedron& a, Polyhedron b) {
    for (const auto& face : a.faces) {
        Cut parts = cut(b, {face_normal(a, face), a.vertices[face.vertices[0]]}, 0);
        if (parts.outcome == CutOutcome::above) return 0;
        if (parts.outcome == CutOutcome::cut) b = std::move(parts.below);
    }
    return mass_properties(b).volume;
}

double shared_volume(const std::vector<Polyhedron>& parts) {
    double most = 0;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) most = std::max(most, shared_volume(parts[i], parts[j]));
    return most;
}

/// How far a corner of the body is outside of all parts.
double left_out(const std::vector<Polyhedron>& body, const std::vector<Polyhedron>& parts) {
    double worst = 0;
    for (const Polyhedron& piece : body)
        for (const Vec3& v : piece.vertices) {
            double nearest = 1e300;
            for (const Polyhedron& part : parts) {
                double outside = -1e300;
                for (const auto& face : part.faces)
                    outside = std::max(outside, face_normal(part, face).dot(v - part.vertices[face.vertices[0]]));
                nearest = std::min(nearest, outside);
            }
            worst = std::max(worst, nearest);
        }
    return worst;
}

std::vector<Vec3> section(const std::vector<std::array<double, 2>>& corners, double y) {
    std::vector<Vec3> result;
    for (const auto& [x, z] : corners) result.emplace_back(x, y, z);
    return result;
}

std::vector<Polyhedron> prism(const std::vector<std::array<double, 2>>& corners) {
    return make_prism(section(corners, 0), section(corners, 2)).parts;
}

std::vector<Polyhedron> placed(std::vector<Polyhedron> parts, const Mat3& turn, const Vec3& move) {
    for (Polyhedron& part : parts)
        for (Vec3& v : part.vertices) v = turn * v + move;
    return parts;
}

} // namespace

TEST(FewParts, AnAngleAndACrossAreExact) {
    const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (const bool turned : {false, true}) {
        const auto place = [&](std::vector<Polyhedron> parts) {
            return turned ? placed(std::move(parts), turn, Vec3(1e5, -2e5, 3e4)) : parts;
        };
        const double exact = turned ? 1e-8 : 1e-12;
        const auto angle = place(prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}));
        const auto two = few_convex_parts(angle, 2);
        EXPECT_LE(two.size(), 2u);
        EXPECT_NEAR(volume_of_parts(two), 10, 10 * exact);
        const auto cross = place(
            prism({{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}}));
        const auto three = few_convex_parts(cross, 3);
        EXPECT_EQ(three.size(), 3u);
        EXPECT_NEAR(volume_of_parts(three), 10, 10 * exact);
        EXPECT_NEAR(shared_volume(three), 0, 1e-6);
    }
}

TEST(FewParts, MorePartsAreNearerToTheBody) {
    // Half a ring of twelve voussoirs.
    std::vector<std::array<double, 2>> ring;
    for (int i = 0; i <= 12; ++i) ring.push_back({3 * std::cos(i * 0.2618), 3 * std::sin(i * 0.2618)});
    for (int i = 12; i >= 0; --i) ring.push_back({2 * std::cos(i * 0.2618), 2 * std::sin(i * 0.2618)});
    const auto body = prism(ring);
    const double volume = volume_of_parts(body);
    double before = 1e300;
    for (const std::size_t n : {1, 2, 3, 4, 6, 8}) {
        const auto parts = few_convex_parts(body, n);
        EXPECT_LE(parts.size(), n);
        const double now = volume_of_parts(parts);
        EXPECT_GE(now, volume * (1 - 1e-12));
        EXPECT_LE(now, before);
        EXPECT_LT(shared_volume(parts), 1e-9 * volume) << n;
        EXPECT_LT(left_out(body, parts), 1e-8) << n;
        before = now;
    }
    EXPECT_LT(before, 1.05 * volume);
    EXPECT_EQ(few_convex_parts(body, body.size()).size(), body.size());
}
