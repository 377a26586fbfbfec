// The common part of two rigid blocks, and the force that follows from it. docs/theory/contacts.md, "Corners and edges".
#pragma once

#include "model/model.hpp"

#include <array>

namespace kaya {

struct OverlapScratch;

/// Sub-contacts that carry the force of an overlap; others of the contact rest.
constexpr Row carriers = 4;

/// The common part of two rigid blocks as a contact sees it.
struct OverlapPatch {
    double carried = 0;         ///< normal force over normal stiffness, length^3; 0 when they do not overlap
    double energy = 0;          ///< of it over the normal stiffness: length^4
    double depth = 0;           ///< greatest thickness along the normal
    double area = 0;            ///< seen along the normal
    bool lies = false;          ///< faces lie on each other, or nearly so
    double twist = 0;           ///< moment about the normal over the normal force: length
    Vec3 normal = Vec3::Zero(); ///< unit, from block 1 to block 2
    Vec3 centre = Vec3::Zero(); ///< the normal force acts along the line through it
    Mat3 second = Mat3::Zero(); ///< second moments of the common volume about its centroid, over the volume: length^2

    /// A joint of this area that is closed by the depth carries as much.
    double carrying_area(double least) const { return carried > 0 ? carried / depth : least; }
    Vec3 longest_edge = Vec3::Zero(); ///< direction of the longest edge of the common part in the plane of the contact
};

/// Closure besides that of the places of the blocks: `closure` + tilt . (x - centroid of block 1), along a direction.
struct ClosureOffset {
    double closure = 0;
    Vec3 tilt = Vec3::Zero();
    Vec3 along = Vec3::Zero(); ///< unit; zero is the contact's normal
};

/// Two rigid blocks that may overlap.
struct OverlapPair {
    Row block1, block2;
    Row face1 = no_row,
        face2 = no_row; ///< faces that lie on each other or nearly so; none where corners or edges touch
    double least_area;  ///< see ContactPlane
};

/// The common part of two rigid blocks, the second one moved against `along` by the offset. Its force is the gradient of an
/// energy, so that no motion of the blocks makes any. `normal` is also the normal of the patch where there is no common
/// part.
OverlapPatch overlap_patch(const Model& model, const OverlapPair& pair, const Vec3& normal, const ClosureOffset& offset,
                           OverlapScratch& scratch);

/// Whose surface gives a contact between rigid blocks its normal and its depth: 1, that of block 1; 0, that of block 2,
/// where one is more than twice as large as the other; 0.5, the mean of both. It depends on the two blocks only and not
/// on their order.
double part_of_first(const Model& model, Row block1, Row block2);

/// Both blocks are rigid.
bool between_rigid(const Model& model, Row contact);

/// Whether depths are those below one face of each block. Any depth that goes with a block serves; this one is the
/// closure of the joint, and the faces around it, which bound a strip as wide as the joint is closed, do not count.
bool lie_on_each_other(const Model& model, const OverlapPair& pair);

/// The offset of a contact; along its normal where none was noted.
ClosureOffset offset_of(const Contacts& contacts, Row contact);

/// The two blocks of a contact.
OverlapPair pair_of(const Contacts& contacts, Row contact);

/// The next rung above an area of a ladder with four rungs to an octave: so the stiffness of a contact that rolls does not
/// change in each cycle.
double rung_above(double area, double least);

/// A unit vector in the plane of a normal: along `axis`, or along `wanted` where that says nothing.
Vec3 axis_in_plane(const Vec3& axis, const Vec3& wanted, const Vec3& normal);

/// Four places about the centre that share the force equally and have the second moments of its pressure. `u` is a unit
/// vector in the plane; they lie about the directions between it and the one across.
std::array<Vec3, carriers> places_of(const OverlapPatch& patch, const Vec3& u);

} // namespace kaya
