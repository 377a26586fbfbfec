// A mesh of tetrahedra that can be changed, and the exchanges of tetrahedra for others that fill the same room. Private to geometry.
#pragma once

#include "geometry/mesh/freedom.hpp"
#include "geometry/mesh/mesh_points.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace kaya {

/// Quality measure: the shape as a whole, the least angle between faces, the worse of both.
enum class Measure { shape, both, angle };

/// Least gain of an exchange or a move.
constexpr double least_gain = 1e-3;

/// Where blocks meet, those of block 0 are improved. Others may get worse, but not below this, unless they are worse already.
constexpr double least_of_others = 0.31; // the sine of 18 degrees

/// Tetrahedra of one block, or of adjacent blocks. Deleted ones keep their index until the end.
class ChangeableTets {
public:
    using Tet = std::array<int, 4>;

    /// Points on faces are fixed, others may move freely.
    ChangeableTets(MeshPoints mesh_points, const std::vector<Tet>& given);

    void add(const Tet& t, int of_block);
    void remove(int number);
    void exchange(const std::vector<int>& old_tets, const std::vector<Tet>& new_tets);
    int add_point(const Vec3& x, std::vector<int> on_faces = {}, Motion motion = {});

    double quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) const;
    double quality(const Tet& t) const;
    double worst_of(const std::vector<int>& numbers) const;

    /// Whether anything around a tetrahedron has changed since its last check.
    bool fresh(int number) const {
        return std::ranges::any_of(tets[number], [&](int v) { return changed_at_[v] > seen_[number]; });
    }
    void mark_seen(int number) { seen_[number] = ++clock_; }
    /// Whether anything around a point has changed since no better place was found for it.
    bool can_move(int point) const { return changed_at_[point] > settled_[point]; }
    void mark_settled(int point) { settled_[point] = ++clock_; }
    void revisit_all() {
        std::ranges::fill(seen_, 0);
        std::ranges::fill(settled_, 0);
    }
    void has_moved(int point);
    std::vector<int> around_edge(int a, int b) const;

    MeshPoints points;
    Measure measure = Measure::shape;
    std::vector<Tet> tets;
    std::vector<int> block; ///< of each tetrahedron
    std::vector<bool> alive;
    std::vector<std::vector<int>> at_point;
    std::vector<Motion> motions; ///< of each point
    /// Indices in points.faces where edges may be swapped, on all sides at once.
    std::vector<int> open_faces;
    /// Changes of triangles of the surface: the edge from a to b was swapped for that from c to d, or divided at c when d is -1.
    std::vector<std::array<int, 4>> surface_changes;

private:
    std::size_t clock_ = 1;
    std::vector<std::size_t> changed_at_, settled_; ///< points
    std::vector<std::size_t> seen_;                 ///< tetrahedra
};

/// Removes the edge from the mesh when the tetrahedra that fill the ring around it are better (Klincsek 1980; de l'Isle and George 1995).
/// An edge in an open face is swapped for the opposite diagonal, if that is better on each side.
bool remove_edge(ChangeableTets& mesh, int a, int b);

/// Three tetrahedra around a new edge instead of two with a common triangle, the one opposite that corner of the first.
bool insert_edge(ChangeableTets& mesh, int number, int corner);

/// A new point in the middle of an edge, on the faces that are given and with that freedom.
void divide_edge(ChangeableTets& mesh, int a, int b, std::vector<int> faces, const Motion& motion);

} // namespace kaya
