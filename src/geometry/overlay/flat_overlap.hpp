// The intersection of two convex bodies with nearly parallel faces: a wedge over a polygon.
#pragma once

#include "geometry/polyhedra/convex_overlap.hpp"

#include <array>
#include <vector>

namespace kaya {

/// A convex face: its corners anticlockwise from outside, and its unit outward normal.
struct ConvexFace {
    std::vector<Vec3> corners;
    Vec3 outward = Vec3::Zero();
};

/// The wedge between two faces, over the part of their common polygon where the closure, the distance by which one face lies below the
/// other, is positive. The sides of the bodies count as perpendicular to the polygon: exact in the limit of small closure over the size of
/// the polygon and small angle between the faces.
class FlatOverlap {
public:
    /// Intersects two opposite faces. False if they have nothing in common.
    bool find(const ConvexFace& face1, const ConvexFace& face2);

    /// Greatest closure over the first face, also beyond the second, of the last find, whatever it returned.
    double deepest_below() const { return deepest_below_; }
    /// The integrals of the closure (volume), and of half its square (the depth below one face).
    const OverlapGradient& volume() const { return volume_; }
    const OverlapGradient& depth() const { return depth_; }
    const OverlapMoments& moments() const { return moments_; }
    double area() const { return area_; }       ///< on which the closure is positive
    double deepest() const { return deepest_; } ///< greatest closure there
    double extent() const { return extent_; }   ///< distance of its farthest corner from the centroid of the wedge
    Vec3 longest_edge() const;

private:
    /// A corner of the polygon.
    struct Corner {
        double u, v, closure;
        bool of_second; ///< the edge from here to the next corner lies on that of the second face
    };

    void project(const ConvexFace& face1, const ConvexFace& face2);
    void clip_by_second();
    void keep_closed();
    void cut(bool of_second);
    void integrate();
    void push_edges();
    Vec3 place(double u, double v) const {
        return origin_ + u * axis_u_ + v * axis_v_ + (height_ + u * slope_u_ + v * slope_v_) * normal_;
    }

    Vec3 origin_, normal_, axis_u_, axis_v_;
    double height_ = 0, slope_u_ = 0, slope_v_ = 0; ///< of the plane midway between the faces
    Vec3 push_;                                     ///< minus the derivative of the closure as the second body moves
    std::vector<Corner> polygon_, old_;
    std::vector<std::array<double, 2>> second_; ///< polygon of the second face, anticlockwise along the normal
    std::vector<double> above_;
    OverlapGradient volume_, depth_;
    OverlapMoments moments_;
    double area_ = 0, deepest_ = 0, deepest_below_ = 0, extent_ = 0;
};

} // namespace kaya
