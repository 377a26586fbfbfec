// The shares of vertices, edges and places in the surface of a block: the areas of contacts at corners and edges (docs/theory/contacts.md, 11).
#pragma once

#include "mechanics/shape/surfaces.hpp"
#include "model/tables/model.hpp"

#include <array>

namespace kaya {

class SurfaceShares {
public:
    SurfaceShares(const Model& model, const Surfaces& surfaces) : model_(model), surfaces_(surfaces) {}

    /// The whole surface share of the gridpoints of a zoned side; infinite for a rigid block.
    double whole_of_side(Row block, const Attachment& side) const;

    /// The share of a surface point, projected along a direction out of the block: that of the vertices around it.
    double of_side(Row block, const Attachment& side, const Vec3& outward) const;

    /// The share of a vertex. It varies continuously as the block turns: a corner of a cube lying on its face has a quarter of the face.
    double of_vertex(Row block, Row vertex, const Vec3& outward) const;

    /// The share of a point on an edge: that of the edge's ends.
    double of_edge(Row block, const std::array<Row, 2>& ends, const Vec3& outward) const;

    /// The share of one side of an overlay point: of the vertex at a vertex, of the edge on an edge between faces, zero inside a face.
    double of_point(Row block, const Attachment& side, const Vec3& outward) const;

private:
    template <class Of> double sum_at_vertex(Row block, Row vertex, const Of& of) const;

    const Model& model_;
    const Surfaces& surfaces_;
};

} // namespace kaya
