// The common volume of two rigid blocks and the force that follows from it. docs/theory/contacts.md, "Corners and edges".
#pragma once

#include "geometry/polyhedra/convex_overlap.hpp"
#include "mechanics/lanes/eight.hpp"
#include "mechanics/shape/rigid_pair.hpp"
#include "model/measure/overlap_rows.hpp"
#include "model/tables/model.hpp"

#include <algorithm>

namespace kaya {

struct OverlapScratch;

/// 1 - cosine of 2 degrees: the closure of faces within it is the depth below them alone.
constexpr double nearly_parallel = 6.1e-4;

/// Area and closures of the carriers of an overlap, as joint models see them.
struct CarrierRows {
    double area; ///< of each
    std::array<double, carriers> closure;
};

/// The common volume of two rigid blocks as a contact sees it.
struct OverlapPatch {
    double carried = 0; ///< normal force over normal stiffness, length^3; 0 when they do not overlap
    double energy = 0;  ///< energy over the normal stiffness: length^4
    double depth = 0;   ///< greatest thickness along the normal
    double area = 0;    ///< seen along the normal
    bool lies = false;  ///< faces are parallel, or nearly so: depths are mostly those below one face of each block
    double twist = 0;   ///< moment about the normal over the normal force: length
    Vec3 normal = Vec3::Zero(); ///< unit, from block 1 to block 2
    Vec3 centre = Vec3::Zero(); ///< the normal force acts along the line through it
    Mat3 second = Mat3::Zero(); ///< second moments of the common volume about its centroid, over the volume: length^2

    /// A joint of this area, closed by the depth, carries the same force.
    double carrying_area(double least) const { return carried > 0 ? carried / depth : least; }
    /// Rows of the same force that have what is closed, and its mean closure; of a tip whose least joint carries more, that of the joint.
    CarrierRows rows(double least) const;
    /// Direction of the longest edge of the common part in the plane of the contact; none where the axis of the pair has a direction there.
    Vec3 longest_edge = Vec3::Zero();
};

/// Integrals of an overlap for joint models that stiffen with closure: docs/theory/contacts.md, (10c). Places are relative to `origin`.
struct OverlapSlopes {
    OverlapGradient energy;  ///< over the stiffness: length^4
    OverlapGradient closure; ///< the mean closure 2U/V: length
    Vec3 origin = Vec3::Zero(), centroid = Vec3::Zero();
};

/// Closure in addition to that of the positions of the blocks: `closure` + tilt . (x - centroid of block 1), along a direction.
struct ClosureOffset {
    double closure = 0;
    Vec3 tilt = Vec3::Zero();
    Vec3 along = Vec3::Zero(); ///< unit; zero is the contact's normal
};

/// Two rigid blocks that may overlap.
struct OverlapPair {
    Row block1, block2;
    Row face1 = no_row,
        face2 = no_row;       ///< nearly parallel faces; none for corners or edges
    double least_area;        ///< see ContactPlane
    Vec3 axis = Vec3::Zero(); ///< see OverlapPatch::longest_edge
};

/// The common volume of two rigid blocks, the second one shifted against `along` by the offset. Its force is the gradient of an energy, so
/// no motion of the blocks creates energy. `normal` is also the normal of an empty patch. `slopes` receives its integrals, unless it is empty.
OverlapPatch overlap_patch(const Model& model, const OverlapPair& pair, const Vec3& normal, const ClosureOffset& offset,
                           OverlapScratch& scratch, OverlapSlopes* slopes = nullptr);

/// The area of the common volume as seen along the normal, at less cost; 0 where there is none.
double overlap_area(const Model& model, const OverlapPair& pair, const Vec3& normal, const ClosureOffset& offset,
                    OverlapScratch& scratch);

/// Overlaps up to this depth may come from the rounding of coordinates, of blocks that were made to touch: they carry nothing.
double rounding_of_gap(const Model& model, Row block1, Row block2);

/// The offset of a contact; along its normal if none was stored.
ClosureOffset offset_of(const Contacts& contacts, Row contact);

/// The two blocks of a contact.
OverlapPair pair_of(const Contacts& contacts, Row contact);

/// The next step above an area of a ladder with four steps per octave: the stiffness of a rolling contact does not change in each cycle.
double rung_above(double area, double least);

/// The area of the shear springs of an overlap. It does not follow vibrations of the contact: a block at rest would creep, and gain energy from
/// its weight.
inline double shear_area(const Contacts& contacts, Row contact) {
    return std::max(contacts.shear_area[contact], contacts.area[contact]);
}

/// A unit vector in the plane of a normal: along `axis`, or along `wanted` where that has no direction.
Vec3 axis_in_plane(const Vec3& axis, const Vec3& wanted, const Vec3& normal);

/// How the pressure spreads over the plane of a contact: the second moments M of the common volume there. `u` is a unit vector in the plane.
struct PressureSpread {
    PressureSpread(const OverlapPatch& patch, const Vec3& u);
    /// Of a pressure with these second moments over its force about its centre; `u` is a unit vector across the normal.
    PressureSpread(const Vec3& centre, const Mat3& second, const Vec3& normal, const Vec3& u);

    /// Four places around the centre that share the force equally and have the second moments M, in the first rows; the others are in the
    /// centre. They lie between `u` and the direction across.
    Eight3 places() const;
    /// a M^-1 a of vectors in the plane: 1 on the ellipse of the second moments, which has an area.
    Eight squares_of(const Eight3& arms) const;

    Vec3 centre, u, v;         ///< v is across u, in the plane
    double uu, vv, uv, square; ///< M, and its determinant
};

} // namespace kaya
