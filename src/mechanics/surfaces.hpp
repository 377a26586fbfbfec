// Planes of the faces of blocks as they are now.
#pragma once

#include "model/model.hpp"

#include <vector>

namespace kaya {

/// Area-weighted unit outward normal of a face where its gridpoints are now; zero for a lost face.
Vec3 current_normal(const Model& model, Row face);

class Surfaces {
public:
    /// Looks at the faces of the blocks listed; those of others stay what they were. No block twice.
    void update(const Model& model, const std::vector<Row>& blocks);

    const Vec3& normal(Row face) const { return planes_[face].normal; }
    /// How far the block reaches along the normal: x . normal of its outermost vertex; infinite for a lost face.
    double reach(Row face) const { return planes_[face].reach; }

private:
    struct Plane {
        Vec3 normal;
        double reach;
    };
    std::vector<Plane> planes_;
};

} // namespace kaya
