// The corners of a face of a rigid block, in order: its triangles are a fan.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Whether `is` is true for the gridpoint of a corner; the corners after it are not asked.
template <class Is> bool any_corner(const Model& model, Row face, const Is& is) {
    const Span span = model.faces.triangles[face];
    if (span.count == 0) return false;
    const auto& first = model.triangles.gridpoints[span.first];
    if (is(first[0]) || is(first[1])) return true;
    for (Row t = span.first; t < span.end(); ++t)
        if (is(model.triangles.gridpoints[t][2])) return true;
    return false;
}

/// Calls `visit` with the gridpoint of each corner.
template <class Visit> void for_corners(const Model& model, Row face, const Visit& visit) {
    any_corner(model, face, [&](Row g) {
        visit(g);
        return false;
    });
}

} // namespace kaya
