// How the sides of a joint between rigid blocks have moved.
#pragma once

#include "model/tables/model.hpp"

#include <Eigen/Core>

namespace kaya {

/// Displacements and tractions of the sub-contacts of a joint between rigid blocks as linear functions of their places: the sides have moved as
/// planes.
class PlaneMotion {
public:
    PlaneMotion() = default;
    PlaneMotion(const Model& model, Row contact);

    /// Whether all sub-contacts have moved so along the normal, and in the plane.
    bool along_normal() const { return along_normal_; }
    bool in_plane() const { return in_plane_; }
    /// Whether all tractions are so.
    bool carries() const { return carries_; }
    /// Displacements along the normal and of shear at a place in the plane.
    Eigen::Vector4d at(const Vec3& place) const { return motion_ * coordinates(place); }
    /// Stress along the normal, compression positive, and shear stress.
    Eigen::Vector4d traction_at(const Vec3& place) const { return traction_ * coordinates(place); }

private:
    /// In parts of the joint's size, so that no rounding depends on the units.
    Eigen::Vector3d coordinates(const Vec3& place) const {
        return {1, (place - origin_).dot(u_) / size_, (place - origin_).dot(v_) / size_};
    }

    bool along_normal_ = false, in_plane_ = false, carries_ = false;
    double size_ = 1;
    Vec3 origin_ = Vec3::Zero(), u_ = Vec3::Zero(), v_ = Vec3::Zero();
    Eigen::Matrix<double, 4, 3> motion_ = Eigen::Matrix<double, 4, 3>::Zero(), traction_ = motion_;
};

} // namespace kaya
