// Edges are recovered as in a plane triangulation: edges that cross one are swapped until it exists (Sloan 1993, Computers & Structures
// 47).
#include "geometry/mesh/surface_recovery.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <deque>
#include <map>
#include <set>

namespace kaya {
namespace {

using Tet = std::array<int, 4>;
using Triangle = std::array<int, 3>;
using Vec2 = Eigen::Vector2d;
using Edge = std::array<int, 2>;

constexpr std::array<std::array<int, 3>, 4> outer_triangle{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// The triangles of one face, by their directed edges: the point opposite of each.
class WantedTriangles {
public:
    WantedTriangles(const Polyhedron& polyhedron, int face, const MeshPoints& points) : points_(points) {
        const Vec3 normal = face_normal(polyhedron, polyhedron.faces[face]);
        origin_ = polyhedron.vertices[polyhedron.faces[face].vertices[0]];
        u_ = normal.unitOrthogonal();
        v_ = normal.cross(u_);
    }
    void add(const Triangle& t) {
        for (int k = 0; k < 3; ++k) opposite_[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
    }
    bool has(int a, int b) const { return opposite_.contains({a, b}) || opposite_.contains({b, a}); }

    /// Swaps edges until the edge from a to b exists; each swap adds a flat tetrahedron. False when that does not end.
    bool recover(int a, int b, std::vector<Tet>& tetrahedra) {
        std::deque<Edge> crossing = edges_across(a, b);
        std::size_t tries = 100 + 20 * crossing.size() * crossing.size();
        while (!crossing.empty()) {
            if (tries-- == 0) return false;
            const auto [p, q] = crossing.front();
            crossing.pop_front();
            const int r = opposite_.at({p, q}), s = opposite_.at({q, p});
            if (!(turn(r, p, s) > 0) || !(turn(s, q, r) > 0)) { // not convex: later
                crossing.push_back({p, q});
                continue;
            }
            flip(p, q, r, s, tetrahedra);
            if (crosses(r, s, a, b)) crossing.push_back({r, s});
        }
        return has(a, b);
    }

private:
    Vec2 drawn(int point) const {
        const Vec3 x = points_.points[point] - origin_;
        return {x.dot(u_), x.dot(v_)};
    }
    double turn(int a, int b, int c) const {
        const Vec2 o = drawn(a), p = drawn(b) - o, q = drawn(c) - o;
        return p.x() * q.y() - p.y() * q.x();
    }
    bool crosses(int a, int b, int c, int d) const {
        if (a == c || a == d || b == c || b == d) return false;
        return (turn(a, b, c) > 0) != (turn(a, b, d) > 0) && (turn(c, d, a) > 0) != (turn(c, d, b) > 0);
    }
    std::deque<Edge> edges_across(int a, int b) const {
        std::deque<Edge> found;
        for (const auto& [edge, corner] : opposite_)
            if (edge[0] < edge[1] && opposite_.contains({edge[1], edge[0]}) && crosses(edge[0], edge[1], a, b))
                found.push_back(edge);
        return found;
    }
    /// Triangles p q r and q p s become r p s and s q r.
    void flip(int p, int q, int r, int s, std::vector<Tet>& tetrahedra) {
        tetrahedra.push_back({p, q, r, s});
        opposite_.erase({p, q});
        opposite_.erase({q, p});
        add({r, p, s});
        add({s, q, r});
    }

    const MeshPoints& points_;
    Vec3 origin_, u_, v_;
    std::map<Edge, int> opposite_;
};

} // namespace

bool recover_surface(const Polyhedron& polyhedron, const BlockSurface& surface, const MeshPoints& points,
                     std::vector<Tet>& tetrahedra) {
    std::map<Triangle, Triangle> open;
    for (const Tet& t : tetrahedra)
        for (const auto& corner : outer_triangle) {
            const Triangle triangle{t[corner[0]], t[corner[1]], t[corner[2]]};
            Triangle key = triangle;
            std::ranges::sort(key);
            const auto [place, fresh] = open.emplace(key, triangle);
            if (!fresh) open.erase(place);
        }
    std::set<Triangle> wanted;
    for (const auto& t : surface.triangles) {
        Triangle key = t.points;
        std::ranges::sort(key);
        wanted.insert(key);
    }
    if (open.size() != wanted.size()) return false;
    std::map<int, std::vector<Triangle>> wrong; // by face
    for (const auto& [key, triangle] : open) {
        if (wanted.contains(key)) continue;
        const std::vector<int> faces = common_faces(points, {key.begin(), key.end()});
        if (faces.size() != 1) return false;
        wrong[faces.front()].push_back(triangle);
    }
    for (const auto& [face, triangles] : wrong) {
        WantedTriangles now(polyhedron, face, points);
        for (const Triangle& t : triangles) now.add(t);
        for (const auto& t : surface.triangles) {
            if (t.face != face) continue;
            Triangle key = t.points;
            std::ranges::sort(key);
            if (open.contains(key)) continue;
            for (int k = 0; k < 3; ++k) {
                const int a = t.points[k], b = t.points[(k + 1) % 3];
                if (!now.has(a, b) && !now.recover(a, b, tetrahedra)) return false;
            }
        }
    }
    return true;
}

} // namespace kaya
