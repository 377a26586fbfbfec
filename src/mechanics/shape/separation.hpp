// The axis along which two convex blocks are farthest apart, or overlap least.
#pragma once

#include "mechanics/shape/surfaces.hpp"

#include <array>
#include <limits>
#include <vector>

namespace kaya {

struct Separation {
    double distance = -std::numeric_limits<double>::infinity(); ///< along the axis; negative: overlap
    Vec3 normal = Vec3::Zero();                                 ///< from block 1 to block 2
    Row face1 = no_row, face2 = no_row; ///< whose normal it is; neither: it is that of two edges
    std::array<Row, 2> edge1{no_row, no_row}, edge2{no_row, no_row};
    /// Along the normal of a lateral face they overlap by a sliver or less: there is no common area.
    bool apart_sideways = false;
    Row opposite = no_row; ///< where a face gives the axis, the other block's face that points most against it
    double cosine = -2;    ///< of the angle between the two
};

/// When the search for an axis ends, and which axes count as equal.
struct SeparationLimits {
    double enough; ///< an axis that keeps the blocks this far apart is good enough
    double tie;    ///< an axis must beat those before it by this
    double clear;  ///< and the first axis of edges the faces by this
    double sliver; ///< a narrower common area of parallel faces does not count
    double flat;   ///< cosine of the angle up to which faces are parallel
    double stay;   ///< hysteresis: another axis must beat the old one by this
    Row old;       ///< the contact of the blocks so far, with its axis, or no_row
};

/// Scratch memory only.
struct SeparationScratch {
    /// The arc between the normals of the faces at an edge.
    struct Arc {
        Vec3 from, to, axis; ///< axis is the cross product of the ends
        std::array<Row, 2> ends;
    };
    std::vector<double> distances;
    std::vector<char> found;
    std::vector<Arc> arcs1, arcs2;
};

/// Separating axes: face normals, then cross products of edges (Gottschalk, Lin and Manocha 1996), restricted to those whose arcs cross on
/// the sphere of normals (Gregorius 2013). An axis of edges must beat the faces clearly: faces of deformed blocks are slightly warped, and
/// their edges then seem to separate parallel faces.
Separation find_separation(const Model& model, const Surfaces& surfaces, Row block1, Row block2,
                           const SeparationLimits& limits, SeparationScratch& scratch);

} // namespace kaya
