// A closed convex polyhedron with outward faces.
#pragma once

#include "base/vector.hpp"

#include <vector>

namespace kaya {

struct Polyhedron {
    struct Face {
        std::vector<int> vertices; ///< anticlockwise seen from outside
        int joint_set = 0;         ///< the joint set that cut it, 0 for none
        bool open = false;         ///< a joint even between blocks of one body
    };
    std::vector<Vec3> vertices;
    std::vector<Face> faces;
};

/// Volume, first and second moments by exact integrals over the faces (divergence theorem);
/// inertia is about the centroid for unit density.
struct MassProperties {
    double volume = 0;
    Vec3 centroid = Vec3::Zero();
    Mat3 inertia = Mat3::Zero();
};

MassProperties mass_properties(const Polyhedron& polyhedron);

/// The mean of one point or more.
Vec3 mean_of(const std::vector<Vec3>& points);

/// A box with its faces parallel to the axes; limits in any order. Throws Diagnostic when one is empty
/// or a limit is not finite.
Polyhedron make_brick(const Vec3& corner1, const Vec3& corner2);

/// Unit outward normal of a face (Newell).
Vec3 face_normal(const Polyhedron& polyhedron, const Polyhedron::Face& face);

} // namespace kaya
