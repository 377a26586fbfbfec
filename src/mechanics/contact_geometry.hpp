// How two blocks touch: the common plane and the places where force passes.
#pragma once

#include "mechanics/surfaces.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kaya {

struct SearchScratch;

/// One sub-contact to be.
struct ContactPoint {
    Vec3 position = Vec3::Zero(); ///< midway between the two surfaces
    Vec3 centre = Vec3::
        Zero(); ///< of its area, where a linear traction has its mean with the weights of the point; faces with zones only
    double gap = 0; ///< along the normal; negative: overlap
    double area = 0;
    SubContactType type = SubContactType::vertex_face;
    Attachment side1, side2;
};

/// How two blocks touch, but for the places.
struct ContactPlane {
    ContactKind kind = ContactKind::joint;
    ContactType type = ContactType::face_face;
    Vec3 normal = Vec3::Zero(); ///< unit, from the first block to the second
    Vec3 position = Vec3::Zero();
    double area = 0;
    /// Of two rigid blocks: a loaded contact is as stiff as a joint of at least this area, a hundredth of the mean area of a face of the
    /// block with the smaller faces.
    double least_area = 0;
    double gap = 0; ///< of an overlap: how far the blocks are apart; negative: how deep they overlap
    Row face1 = no_row, face2 = no_row; ///< rows of faces that lie on the common plane
    int reference = 0;                  ///< 1 or 2: whose face gives the normal; 0: two edges do
};

/// The points of one touch, at the end of a list that holds those of others before them.
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

/// Faces whose common area is no wider than this do not touch.
double narrowest_contact(const Model& model, Row block1, Row block2);

/// The touch of two blocks whose surfaces are nearer than `margin`; nothing when they are farther apart
/// or touch in an edge or corner of parallel faces without area. Returns whether there is one; if not, points may be
/// left over. Two rigid blocks touch along a joint where their faces lie on each other, or in an overlap; of an overlap
/// the points are not given.
/// `old` is the contact that they have so far, if any.
bool find_geometry(const Model& model, const Surfaces& surfaces, Row block1, Row block2, Row old, double margin,
                   ContactGeometry& geometry, SearchScratch& scratch);

/// Where a sub-contact's side is now.
inline Vec3 attached_position(const Model& model, const Attachment& side) {
    const auto& x = model.gridpoints.position;
    if (side.weights[0] == 1) return x[side.gridpoints[0]];
    return side.weights[0] * x[side.gridpoints[0]] + side.weights[1] * x[side.gridpoints[1]] +
           side.weights[2] * x[side.gridpoints[2]];
}

} // namespace kaya
