#include "geometry/mesh/hexahedron.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

namespace kaya {

std::optional<std::array<int, 8>> hexahedron_corners(const Polyhedron& p) {
    if (p.vertices.size() != 8 || p.faces.size() != 6) return std::nullopt;
    for (const auto& face : p.faces)
        if (face.vertices.size() != 4) return std::nullopt;

    int lowest = 0;
    const auto before = [&p](int a, int b) {
        return std::lexicographical_compare(p.vertices[a].data(), p.vertices[a].data() + 3, p.vertices[b].data(),
                                            p.vertices[b].data() + 3);
    };
    for (int v = 1; v < 8; ++v)
        if (before(v, lowest)) lowest = v;

    std::set<int> neighbours;
    for (const auto& face : p.faces)
        for (int i = 0; i < 4; ++i) {
            if (face.vertices[i] == lowest) {
                neighbours.insert(face.vertices[(i + 1) % 4]);
                neighbours.insert(face.vertices[(i + 3) % 4]);
            }
        }
    if (neighbours.size() != 3) return std::nullopt;

    // The three edges from the lowest corner, each named after the axis it is closest to.
    std::array<int, 3> along;
    std::vector<int> left(neighbours.begin(), neighbours.end());
    for (int axis = 0; axis < 3; ++axis) {
        const auto best = std::max_element(left.begin(), left.end(), [&](int a, int b) {
            const Vec3 ea = (p.vertices[a] - p.vertices[lowest]).normalized();
            const Vec3 eb = (p.vertices[b] - p.vertices[lowest]).normalized();
            return std::abs(ea[axis]) < std::abs(eb[axis]);
        });
        along[axis] = *best;
        left.erase(best);
    }
    const Vec3 o = p.vertices[lowest];
    if ((p.vertices[along[0]] - o).dot((p.vertices[along[1]] - o).cross(p.vertices[along[2]] - o)) < 0)
        std::swap(along[1], along[2]);

    std::array<int, 8> corner;
    corner.fill(-1);
    corner[0] = lowest;
    for (int axis = 0; axis < 3; ++axis) corner[1 << axis] = along[axis];
    // A face that holds corner 0 and two of its neighbours gives the corner between them.
    for (const auto& face : p.faces) {
        int code = 0;
        int fourth = -1;
        bool has_lowest = false;
        for (const int v : face.vertices) {
            if (v == lowest) has_lowest = true;
            else if (v == along[0]) code |= 1;
            else if (v == along[1]) code |= 2;
            else if (v == along[2]) code |= 4;
            else fourth = v;
        }
        if (has_lowest && fourth >= 0) corner[code] = fourth;
    }
    for (int v = 0; v < 8; ++v)
        if (std::find(corner.begin(), corner.end(), v) == corner.end()) corner[7] = v;
    if (std::find(corner.begin(), corner.end(), -1) != corner.end()) return std::nullopt;
    return corner;
}

namespace {

/// Where the i-th of n + 1 points stands on a unit length whose n parts grow by a ratio.
std::vector<double> graded(int n, double ratio) {
    std::vector<double> places(n + 1);
    for (int i = 0; i <= n; ++i) {
        const bool even = std::abs(ratio - 1) < 1e-12;
        places[i] = even ? static_cast<double>(i) / n : (std::pow(ratio, i) - 1) / (std::pow(ratio, n) - 1);
    }
    places[n] = 1;
    return places;
}

} // namespace

TetMesh grid_mesh(const Polyhedron& polyhedron, const std::array<int, 8>& corner, const GridPlaces& places) {
    const auto at = [&](int c) -> const Vec3& { return polyhedron.vertices[corner[c]]; };
    std::array<int, 3> n;
    for (int axis = 0; axis < 3; ++axis) n[axis] = static_cast<int>(places[axis].size()) - 1;
    TetMesh mesh;
    const auto index = [&](int i, int j, int k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
    for (int k = 0; k <= n[2]; ++k)
        for (int j = 0; j <= n[1]; ++j)
            for (int i = 0; i <= n[0]; ++i) {
                const std::array<double, 3> t{places[0][i], places[1][j], places[2][k]};
                Vec3 point = Vec3::Zero();
                for (int c = 0; c < 8; ++c) {
                    double weight = 1;
                    for (int axis = 0; axis < 3; ++axis) weight *= c & (1 << axis) ? t[axis] : 1 - t[axis];
                    // Weights of 0 are left out so that corners stay the vertices to the last bit.
                    if (weight > 0) point += weight * at(c);
                }
                mesh.points.push_back(point);
            }

    // Kuhn: one tetrahedron for each order in which the three axes can be walked from corner to corner.
    static constexpr std::array<std::array<int, 3>, 6> walks{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    mesh.per_cell = static_cast<int>(walks.size());
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i)
                for (std::size_t w = 0; w < walks.size(); ++w) {
                    std::array<int, 3> cell{i, j, k};
                    std::array<int, 4> tet;
                    tet[0] = index(cell[0], cell[1], cell[2]);
                    for (int s = 0; s < 3; ++s) {
                        ++cell[walks[w][s]];
                        tet[s + 1] = index(cell[0], cell[1], cell[2]);
                    }
                    if (w >= 3) std::swap(tet[2], tet[3]); // odd orders are mirror images
                    mesh.tetrahedra.push_back(tet);
                }

    // Boundary: on each side of the grid two triangles per cell, with the diagonal of the walks.
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f) {
        int common_set = 7, common_clear = 7;
        for (int c = 0; c < 8; ++c) {
            const auto& loop = polyhedron.faces[f].vertices;
            if (std::find(loop.begin(), loop.end(), corner[c]) == loop.end()) continue;
            common_set &= c;
            common_clear &= ~c;
        }
        const bool high = common_set != 0;
        const int bit = high ? common_set : common_clear;
        const int axis = bit == 1 ? 0 : bit == 2 ? 1 : 2;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int b = 0; b < n[v]; ++b)
            for (int a = 0; a < n[u]; ++a) {
                const auto node = [&](int da, int db) {
                    std::array<int, 3> q;
                    q[axis] = high ? n[axis] : 0;
                    q[u] = a + da;
                    q[v] = b + db;
                    return index(q[0], q[1], q[2]);
                };
                std::array<int, 3> first{node(0, 0), node(1, 0), node(1, 1)};
                std::array<int, 3> second{node(0, 0), node(1, 1), node(0, 1)};
                if (!high) {
                    std::swap(first[1], first[2]);
                    std::swap(second[1], second[2]);
                }
                mesh.boundary.push_back({first, static_cast<int>(f)});
                mesh.boundary.push_back({second, static_cast<int>(f)});
            }
    }
    return mesh;
}

std::optional<TetMesh> hexahedron_mesh(const Polyhedron& polyhedron, const std::array<int, 3>& parts,
                                       const std::array<double, 3>& ratio) {
    const auto corner = hexahedron_corners(polyhedron);
    if (!corner) return std::nullopt;
    // Corners count in a right-handed order, which may have put the edge nearest to z before that nearest to y.
    const auto edge = [&](int axis) {
        return Vec3((polyhedron.vertices[(*corner)[1 << axis]] - polyhedron.vertices[(*corner)[0]]).normalized());
    };
    std::array<int, 3> axes{0, 1, 2};
    if (std::abs(edge(2).y()) > std::abs(edge(1).y())) std::swap(axes[1], axes[2]);
    GridPlaces places;
    for (int axis = 0; axis < 3; ++axis) {
        const double growth = edge(axis)[axes[axis]] < 0 ? 1 / ratio[axes[axis]] : ratio[axes[axis]];
        places[axis] = graded(parts[axes[axis]], growth);
    }
    TetMesh mesh = grid_mesh(polyhedron, *corner, places);
    for (const auto& t : mesh.tetrahedra) {
        const Vec3& x = mesh.points[t[0]];
        if (!((mesh.points[t[1]] - x).dot((mesh.points[t[2]] - x).cross(mesh.points[t[3]] - x)) > 0))
            return std::nullopt;
    }
    return mesh;
}

} // namespace kaya
