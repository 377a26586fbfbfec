// The common plane of two blocks, and points of a contact, before they are rows of the tables.
#pragma once

#include "model/measure/joint_opening.hpp"
#include "model/tables/model.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kaya {

/// A future sub-contact.
struct ContactPoint {
    Vec3 position = Vec3::Zero(); ///< midway between the two surfaces
    Vec3 centre = Vec3::
        Zero(); ///< centre of its area for the weights of the point, where a linear traction has its mean; zoned faces only
    double gap = 0; ///< along the normal; negative: overlap
    double area = 0;
    SubContactType type = SubContactType::vertex_face;
    Attachment side1, side2;
};

/// The common plane of two blocks, without the points.
struct ContactPlane {
    ContactKind kind = ContactKind::joint;
    ContactType type = ContactType::face_face;
    Vec3 normal = Vec3::Zero(); ///< unit, from the first block to the second
    Vec3 position = Vec3::Zero();
    double area = 0;
    double whole_area = 0; ///< of an overlap: the common area of its faces, 0 for corners and edges
    /// For two rigid blocks: a loaded contact is at least as stiff as a joint of this area, a hundredth of the mean face area of the block
    /// with the smaller faces.
    double least_area = 0;
    double gap = 0;                     ///< of an overlap: the distance of the blocks; negative: the depth of overlap
    Row face1 = no_row, face2 = no_row; ///< rows of faces that lie on the common plane
    int reference = 0;                  ///< 1 or 2: whose face gives the normal; 0: two edges do

    /// Takes the plane of two faces with these outward normals: that of `normal_of_faces`, or beside zones that of the rigid block, which
    /// does not warp. The same in any order of the blocks.
    void lie_on_faces(const Model& model, Row block1, Row block2, const Vec3& outward1, const Vec3& outward2);
};

/// Along the outward normals of two faces: their mean, or that of the much larger block. Unit, or zero if it has no direction.
Vec3 normal_of_faces(const Model& model, Row block1, Row block2, const Vec3& outward1, const Vec3& outward2);

/// The points of one contact, at the end of a list that also holds those of earlier contacts.
class ContactPoints {
public:
    explicit ContactPoints(std::vector<ContactPoint>& list) : list_(&list), first_(list.size()) {}

    auto begin() const { return list_->begin() + static_cast<std::ptrdiff_t>(first_); }
    auto end() const { return list_->end(); }
    std::size_t size() const { return list_->size() - first_; }
    ContactPoint& operator[](std::size_t i) const { return (*list_)[first_ + i]; }
    ContactPoint& add() { return list_->emplace_back(); }
    void clear() { list_->resize(first_); }
    template <class Unwanted> void drop_if(Unwanted unwanted) {
        list_->erase(std::remove_if(begin(), end(), unwanted), end());
    }

private:
    std::vector<ContactPoint>* list_;
    std::size_t first_;
};

struct ContactGeometry : ContactPlane {
    ContactPoints points;
};

/// Whether two sides of sub-contacts lie on the same vertex or edge, or in the same triangle.
inline bool on_same_gridpoints(const Attachment& a, const Attachment& b) {
    constexpr double none = 1e-9;
    const auto all_in = [](const Attachment& from, const Attachment& to) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (from.weights[i] <= none) continue;
            bool found = false;
            for (std::size_t j = 0; j < 3; ++j)
                found = found || (to.gridpoints[j] == from.gridpoints[i] && to.weights[j] > none);
            if (!found) return false;
        }
        return true;
    };
    return all_in(a, b) && all_in(b, a);
}

} // namespace kaya
