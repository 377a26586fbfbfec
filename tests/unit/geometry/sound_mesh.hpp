// Requirements of every mesh of a block.
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <vector>

namespace kaya {

/// Requirements independent of the shape.
inline void expect_sound(const Polyhedron& p, const TetMesh& m) {
    double volume = 0;
    std::map<std::array<int, 3>, int> uses;
    for (const auto& t : m.tetrahedra) {
        const Vec3& a = m.points[t[0]];
        const double part = (m.points[t[1]] - a).dot((m.points[t[2]] - a).cross(m.points[t[3]] - a)) / 6;
        EXPECT_GT(part, 0);
        volume += part;
        for (int skip = 0; skip < 4; ++skip) {
            std::array<int, 3> key{};
            for (int i = 0, k = 0; i < 4; ++i)
                if (i != skip) key[k++] = t[i];
            std::sort(key.begin(), key.end());
            EXPECT_LE(++uses[key], 2);
        }
    }
    const double wanted = mass_properties(p).volume;
    EXPECT_NEAR(volume, wanted, 1e-11 * wanted);
    for (const auto& triangle : m.boundary) {
        std::array<int, 3> key = triangle.points;
        std::sort(key.begin(), key.end());
        EXPECT_EQ(uses[key], 1);
        uses.erase(key);
    }
    for (const auto& [key, count] : uses) EXPECT_EQ(count, 2);
    // The triangles of each face cover it: same area, same normal.
    std::vector<Vec3> area(p.faces.size(), Vec3::Zero());
    for (const auto& triangle : m.boundary) {
        const auto& [a, b, c] = triangle.points;
        const Vec3 half = (m.points[b] - m.points[a]).cross(m.points[c] - m.points[a]) / 2;
        EXPECT_GT(half.dot(face_normal(p, p.faces[triangle.face])), 0);
        area[triangle.face] += half;
    }
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
        Vec3 whole = Vec3::Zero();
        const auto& loop = p.faces[f].vertices;
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            whole +=
                (p.vertices[loop[i]] - p.vertices[loop[0]]).cross(p.vertices[loop[i + 1]] - p.vertices[loop[0]]) / 2;
        EXPECT_LT((whole - area[f]).norm(), 1e-11 * std::max(1.0, whole.norm()));
    }
    std::set<std::array<double, 3>> points;
    for (const Vec3& v : m.points) EXPECT_TRUE(points.insert({v.x(), v.y(), v.z()}).second);
    for (const Vec3& v : p.vertices) EXPECT_TRUE(points.contains({v.x(), v.y(), v.z()}));
    std::set<int> used;
    for (const auto& t : m.tetrahedra) used.insert(t.begin(), t.end());
    EXPECT_EQ(used.size(), m.points.size());
}

} // namespace kaya
