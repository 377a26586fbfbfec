// Integrals over the intersection of two convex polyhedra: one that is clipped by the faces of the other.
#pragma once

#include "geometry/polyhedra/convex_clip.hpp"

#include <vector>

namespace kaya {

/// Integrals over the common part.
struct OverlapMoments {
    double volume = 0;
    Vec3 centroid = Vec3::Zero();
    Mat3 second = Mat3::Zero(); ///< integral of (x - centroid)(x - centroid)' over volume: length^2
};

/// Exact integrals by tetrahedra over the faces (Tonon 2005). No volume where the polyhedron is empty.
OverlapMoments moments_of(const ConvexClip& part);

/// An integral over the intersection of two bodies, and minus its gradient for translations and rotations (about the origin) of the second
/// body.
struct OverlapGradient {
    double value = 0;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();

    void add(const OverlapGradient& other, double weight);
};

/// The volume. `second` says whether the subject is the second body.
OverlapGradient volume_gradient(const ConvexClip& part, double volume, bool second);

} // namespace kaya
