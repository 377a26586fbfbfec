// Requirements of every polyhedron: each half-edge has exactly one partner, and it is convex.
#pragma once

#include "geometry/polyhedra/polyhedron.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace kaya::test {

inline bool closed(const Polyhedron& p) {
    std::map<std::pair<int, int>, int> half_edges;
    std::vector<bool> used(p.vertices.size(), false);
    for (const auto& face : p.faces) {
        if (face.vertices.size() < 3) return false;
        for (std::size_t i = 0; i < face.vertices.size(); ++i) {
            const int a = face.vertices[i], b = face.vertices[(i + 1) % face.vertices.size()];
            if (a == b || ++half_edges[{a, b}] > 1) return false;
            used[a] = true;
        }
    }
    for (const auto& [edge, count] : half_edges)
        if (!half_edges.contains({edge.second, edge.first})) return false;
    return std::find(used.begin(), used.end(), false) == used.end() && p.faces.size() > 3;
}

/// The largest distance of a vertex outside the plane of a face.
inline double worst_bulge(const Polyhedron& p) {
    double worst = 0;
    for (const auto& face : p.faces) {
        const Vec3 normal = face_normal(p, face);
        for (const Vec3& v : p.vertices) worst = std::max(worst, normal.dot(v - p.vertices[face.vertices[0]]));
    }
    return worst;
}

/// The largest distance of a vertex of a face from its plane.
inline double worst_warp(const Polyhedron& p) {
    double worst = 0;
    for (const auto& face : p.faces) {
        const Vec3 normal = face_normal(p, face);
        for (const int v : face.vertices)
            worst = std::max(worst, std::abs(normal.dot(p.vertices[v] - p.vertices[face.vertices[0]])));
    }
    return worst;
}

} // namespace kaya::test
