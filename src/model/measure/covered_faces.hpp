// Faces that lie on faces of other blocks.
#pragma once

#include "model/tables/model.hpp"

#include <array>
#include <map>
#include <vector>

namespace kaya {

/// Two faces of blocks that lie on each other.
struct FacePair {
    Row face1, face2;
    double area; ///< that they have in common
};

/// The parts of faces that contacts and ties cover. The contacts must be up to date, and stay. Less than a thousandth of a face or
/// a triangle counts as nothing, covered or free.
class CoveredFaces {
public:
    using Corners = std::array<Vec3, 3>;

    /// `tied`: faces without a contact, by tied_face_pairs of model/edit/ties.hpp.
    CoveredFaces(const Model& model, const std::vector<FacePair>& tied);

    /// The part of the triangle's area that is covered, 0 to 1.
    double share(Row triangle) const;
    /// The covered parts of a triangle as triangles with the same side outside; none where all or nothing of it is covered.
    std::vector<Corners> parts(Row triangle) const;

private:
    /// The polygons of a face that is covered in part are found when a triangle needs them.
    enum class Cover : char { none, part, whole };
    struct Part {
        Row face;
        FacePair pair;
        Vec3 normal;
    };
    const std::vector<std::vector<Vec3>>& polygons_on(Row face) const;
    std::vector<Corners> common_parts(Row triangle) const;
    double share_of(const std::vector<Corners>& parts, Row triangle) const;

    const Model& model_;
    std::vector<Cover> cover_; ///< by face
    std::vector<Part> parts_;  ///< of faces covered in part, in their order
    mutable std::map<Row, std::vector<std::vector<Vec3>>> polygons_;
};

} // namespace kaya
