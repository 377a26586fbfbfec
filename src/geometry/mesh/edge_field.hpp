// How long edges of zones are to be, everywhere alike or by the distance from a place.
#pragma once

#include "base/vector.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

#include <algorithm>
#include <vector>

namespace kaya {

/// The edge length varies linearly from the centre to the distance, and beyond it at the same rate (at least a quarter of the distance)
/// until it is `edge`.
struct EdgeField {
    double edge = 0;     ///< far from the centre; everywhere when the distance is 0
    double distance = 0; ///< from the centre
    double at_center = 0, at_distance = 0;
    Vec3 center = Vec3::Zero();

    EdgeField(double everywhere) : edge(everywhere) {} // a number is a field
    EdgeField(double far, const Vec3& place, double there, double away, double reach)
        : edge(far), distance(reach), at_center(there), at_distance(away), center(place) {}

    bool even() const { return distance == 0; }
    double at(const Vec3& x) const { return even() ? edge : at_radius((x - center).norm()); }
    double least() const { return even() ? edge : std::min({edge, at_center, at_distance}); }
    double change() const; ///< with the distance, at most
    double least_in(const Box& box) const;
    /// Volume over the cube of the edge, about: a sixth of the zones that cells make.
    double cubes_in(const Polyhedron& block) const;
    /// Throws Diagnostic when an edge is not a number above 0.
    void check() const;

private:
    double at_radius(double r) const;
};

/// Number of parts into which the field divides an edge, or several edges on average.
class EdgeParts {
public:
    EdgeParts() = default;
    EdgeParts(const EdgeField& field, const Vec3& from, const Vec3& to);

    void add(const EdgeParts& other, bool turned); ///< turned: its beginning is at the end of this one
    double mean() const { return edges_ ? sum_ / edges_ : 0; }
    double total() const { return sum_; }
    int edges() const { return edges_; }
    /// Positions on a unit length of n + 1 points that divide the edges in n parts.
    std::vector<double> division(int n, bool turned = false) const;

private:
    double sum_ = 0;
    int edges_ = 0;
    std::vector<double> along_; ///< parts up to equal steps of the length; empty if all parts are equal
};

/// The nearest whole number, at least 1. Half-integers always round in the same direction, whatever rounding errors do.
int whole_parts(double parts);

} // namespace kaya
