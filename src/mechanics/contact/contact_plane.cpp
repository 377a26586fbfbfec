#include "mechanics/contact/contact_plane.hpp"

#include "mechanics/shape/overlap_patch.hpp"

namespace kaya {

Vec3 normal_of_faces(const Model& model, Row block1, Row block2, const Vec3& outward1, const Vec3& outward2) {
    const double first = part_of_first(model, block1, block2);
    return (first * outward1 - (1 - first) * outward2).normalized();
}

void ContactPlane::lie_on_faces(const Model& model, Row block1, Row block2, const Vec3& outward1,
                                const Vec3& outward2) {
    const bool zones1 = model.blocks.deformable[block1], zones2 = model.blocks.deformable[block2];
    if (zones1 == zones2) {
        normal = normal_of_faces(model, block1, block2, outward1, outward2);
        return;
    }
    reference = zones1 ? 2 : 1;
    normal = zones1 ? Vec3(-outward2) : outward1;
}

} // namespace kaya
