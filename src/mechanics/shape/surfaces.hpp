// Present planes of the faces of blocks, their vertices and their edges.
#pragma once

#include "mechanics/shape/edges.hpp"
#include "model/tables/lanes.hpp"
#include "model/tables/model.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

namespace kaya {

/// Area-weighted unit outward normal of a face where its gridpoints are now; zero for a degenerate face.
Vec3 current_normal(const Model& model, Row face);

/// Where a block begins along a direction: the least x . direction of its vertices.
inline double lowest(std::span<const Lanes3> vertices, const Vec3& direction) {
    const Lanes3 n = four_times(direction);
    Lanes low = four_times(std::numeric_limits<double>::infinity());
    for (const auto& four : vertices) {
        const Lanes heights = n.dot(four);
        low = heights < low ? heights : low;
    }
    return std::min(std::min(low[0], low[1]), std::min(low[2], low[3]));
}

/// Planes of four faces of a block. If there are fewer, the others have no normal and an infinite reach.
struct FourPlanes {
    Lanes3 normal;
    Lanes reach;
};

class Surfaces {
public:
    /// Updates the faces of the listed blocks; those of others are unchanged. No block twice.
    void update(const Model& model, const std::vector<Row>& blocks);

    const Vec3& normal(Row face) const { return planes_[face].normal; }
    /// How far the block reaches along the normal: x . normal of its outermost vertex; infinite for a degenerate face.
    double reach(Row face) const { return planes_[face].reach; }
    /// The vertices of a block, four at a time; the last one as often as is needed to make the last four whole.
    std::span<const Lanes3> vertices(Row block) const {
        return {vertices_.data() + first_vertices_[block], vertices_.data() + first_vertices_[block + 1]};
    }
    /// A place inside of a block.
    const Vec3& middle(Row block) const { return middles_[block]; }
    /// The planes of the faces of a block, four at a time.
    std::span<const FourPlanes> planes(Row block) const {
        return {four_planes_.data() + first_planes_[block], four_planes_.data() + first_planes_[block + 1]};
    }
    const std::vector<Edge>& edges(Row block) const { return shapes_[block].edges; }
    /// The mean area of its faces when the block was made.
    double mean_face_area(Row block) const { return shapes_[block].mean_face_area; }
    /// The gridpoints of a face, each once and in order.
    std::span<const Row> corners(Row face) const { return planes_[face].corners; }
    /// The triangles of that face, by the places of their gridpoints in `corners`.
    std::span<const std::array<int, 3>> triangles(Row face) const { return planes_[face].triangles; }
    /// The triangles along the other diagonals of its quadrangles: of a face of cells, which is the mean of both (model/measure/cell_faces.hpp),
    /// and of a rigid one with four corners. Empty for other faces, and where blocks are tied to the face.
    std::span<const std::array<int, 3>> other_triangles(Row face) const {
        if (!tied_.empty() && tied_[face]) return {};
        return planes_[face].others;
    }

private:
    /// The part of a block's surface that is constant under motion, and its key.
    struct Shape {
        BlockId block;
        Span gridpoints, faces, triangles;
        std::vector<Edge> edges;
        std::vector<Row> corners;                         ///< of one face after another
        std::vector<std::array<int, 3>> corner_triangles; ///< of each triangle of the block
        std::vector<std::array<int, 3>> other_triangles;  ///< the same with the other diagonals, or empty
        double mean_face_area = 0;
    };
    struct Plane {
        Vec3 normal;
        double reach;
        std::span<const Row> corners; ///< in the block's shape, as the triangles
        std::span<const std::array<int, 3>> triangles, others;
    };

    bool knows(const Model& model, Row block) const;
    void learn(const Model& model, Row block);
    void learn_others(const Model& model, Shape& shape);
    void take_vertices(const Model& model, Row block);
    double reach_of(const Model& model, Row block, const Plane& plane) const;
    void take_planes(const Model& model, Row block);
    void note_ties(const Model& model);

    std::vector<Plane> planes_;
    std::vector<Shape> shapes_;
    std::vector<Lanes3> vertices_;
    std::vector<FourPlanes> four_planes_;
    std::vector<Vec3> middles_;
    std::vector<char> tied_;                                 ///< by face; empty when none is
    std::size_t ties_ = 0;                                   ///< how many there were when they were noted
    std::vector<std::size_t> first_vertices_, first_planes_; ///< of each block in the lists above, and their numbers
};

} // namespace kaya
