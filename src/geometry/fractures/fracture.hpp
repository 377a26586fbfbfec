// Fractures of a network: discs and plane polygons under a number, and what is measured on them.
#pragma once

#include "geometry/fractures/disc.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/plane.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Diameters above this are typing errors.
inline constexpr double largest_fracture = 1e12;

struct Fracture {
    Disc disc;                            ///< of a polygon: the disc of its area in its plane, around its centroid
    std::vector<Vec3> corners = {};       ///< of a convex polygon, in order; empty: the fracture is the disc
    std::int64_t id = 0;                  ///< no two fractures of a model have the same
    std::int32_t dominance = 0;           ///< fractures of a lower number are cut first
    std::int32_t joint_set = 0;           ///< of the faces that it has cut; 0: none yet
    std::vector<std::string> groups = {}; ///< name or slot=name, one of each slot

    bool operator==(const Fracture&) const = default;
};

/// A fracture with these corners. Throws Diagnostic with what is wrong: fewer than three, no area, not plane, not convex, not finite.
Fracture polygon_fracture(const std::vector<Vec3>& corners);

/// Through the centre, with the upward normal.
Plane plane_of(const Fracture& fracture);
double area_of(const Fracture& fracture);
Box box_of(const Fracture& fracture);

/// The corners of a polygon, anticlockwise about the upward normal; of a disc those of a regular polygon with as many sides and its area, which
/// has a level side if the sides are a multiple of four.
std::vector<Vec3> outline_of(const Fracture& fracture, int sides);

/// The part of the fracture inside of an outline in its plane, exact but for rounding. The outline of a polygon is convex.
double area_within(const Fracture& fracture, const std::vector<Vec3>& outline);
double area_in_box(const Fracture& fracture, const Vec3& low, const Vec3& high);
double distance_to(const Fracture& fracture, const Vec3& place);
bool crosses(const Fracture& fracture, const Vec3& begin, const Vec3& end);

/// Which part of a fracture that crosses the sides of a box counts for the percolation parameter.
enum class AtSides {
    nothing,      ///< it is left out
    area_inside,  ///< a disc of the area inside
    scaled_radius ///< a disc whose radius is less by the share of its area inside
};

/// The mean volume, over all orientations of two equal discs, in which the centre of one lies if it meets the other: pi^2 r^3 (Balberg,
/// Anderson, Alexander and Wagner 1984, Phys. Rev. B 30).
double excluded_volume(double radius);

/// Percolation parameter: the sum of pi^2 r^3 over the volume of the box, without unit. A polygon has the radius of the disc of its area.
double percolation(const std::vector<Fracture>& fractures, const Vec3& low, const Vec3& high, AtSides at_sides);

/// Where the fracture crosses a box it becomes the polygon inside; a disc is taken as a polygon of that many sides. False: nothing is left.
bool cut_to_box(Fracture& fracture, const Vec3& low, const Vec3& high, int sides);

/// Whether the fracture is in that group: `slot=name`, or a name in any slot.
bool in_group(const Fracture& fracture, std::string_view group);
/// Puts the fracture into a group, in place of another one of its slot, or takes it out: of a group without a slot in all slots.
void set_group(Fracture& fracture, const std::string& group, bool remove = false);

} // namespace kaya
