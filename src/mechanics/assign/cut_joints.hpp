// Joints of cut blocks go over to the pieces, with all that they carry.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <Eigen/Core>
#include <vector>

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

/// A joint of a block that is about to be cut.
struct WholeJoint {
    ContactId contact;
    BlockId block1, block2;
    Vec3 centroid1; ///< of block1
    PlaneMotion motion;
};

/// The joints of blocks that are about to be cut: once the model has moved or carries forces, all of them, before only those whose material,
/// properties or group differ from those of a newly found one.
std::vector<WholeJoint> whole_joints(Model& model, JointRegistry& joints, const std::vector<Row>& blocks);

/// Finds the contacts of the pieces. Each takes from the joint of the whole blocks, if there was one at its place, tractions, displacements,
/// state, history, properties and group. `origin`: by row of block, the block from which it was cut, which keeps its id as first piece. Does
/// nothing when there are no such joints.
void share_joints(Model& model, JointRegistry& joints, const std::vector<WholeJoint>& whole,
                  const std::vector<BlockId>& origin);

} // namespace kaya
