// Outer faces of cells. They are ruled surfaces, each the mean of the two pairs of triangles of its diagonals: docs/theory/zones.md, "Cells".
#pragma once

#include "model/tables/model.hpp"

#include <array>
#include <vector>

namespace kaya {

using TriangleCorners = std::array<Row, 3>;

/// The other half of the outer face of a cell; no_row for all other triangles.
Row partner_in_cell(const Model& model, Row triangle);

/// The four corners of two triangles with a common edge, anticlockwise from outside; that edge goes from the second to the last one.
std::array<Row, 4> corners_of_face(const TriangleCorners& one, const TriangleCorners& two);

/// The two triangles along the other diagonal of the four corners of two triangles with a common edge, with the same side outside.
std::array<TriangleCorners, 2> other_diagonal(const TriangleCorners& one, const TriangleCorners& two);

/// A triangle that counts with a part of what its area would have.
struct SurfacePart {
    TriangleCorners corners;
    double share = 1;
};

/// The surface of blocks for loads, quiet boundaries and weights.
class CellFaces {
public:
    /// `tied`: rows of the faces on which other blocks are tied (model/edit/ties.hpp); they are triangles, as their ties are.
    CellFaces(const Model& model, const std::vector<Row>& tied);

    /// As partner_in_cell, on faces that are not tied.
    Row partner(Row triangle) const;

    /// Calls part(SurfacePart) for what a triangle has on the four corners of its face: half of it, and half of one of the two triangles of
    /// the other diagonal, whose second belongs to its partner. Only for triangles whose partner counts as well (`with_partner`), else for
    /// the triangle itself.
    template <class Part> void for_parts(Row triangle, bool with_partner, const Part& part) const {
        const TriangleCorners& own = model_.triangles.gridpoints[triangle];
        const Row other = with_partner ? partner(triangle) : no_row;
        if (other == no_row) return part(SurfacePart{own, 1});
        part(SurfacePart{own, 0.5});
        // The triangle with the lower row stands for one of the other pair, its partner for the second.
        const TriangleCorners& theirs = model_.triangles.gridpoints[other];
        const auto pair = triangle < other ? other_diagonal(own, theirs) : other_diagonal(theirs, own);
        part(SurfacePart{pair[triangle < other ? 0 : 1], 0.5});
    }

private:
    const Model& model_;
    std::vector<char> tied_; ///< by face; empty when none is
};

} // namespace kaya
