// Planes of the faces of blocks as they are now, and their edges.
#pragma once

#include "mechanics/edges.hpp"
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
    const std::vector<Edge>& edges(Row block) const { return edges_[block].list; }

private:
    /// The edges of a block, and by what is known that they are still these.
    struct EdgeList {
        BlockId block;
        Span gridpoints, faces, triangles;
        std::vector<Edge> list;
    };
    struct Plane {
        Vec3 normal;
        double reach;
    };
    std::vector<Plane> planes_;
    std::vector<EdgeList> edges_;
};

} // namespace kaya
