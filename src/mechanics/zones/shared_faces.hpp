// Outer faces of cells whose zones share strains. For loads and joints they are the mean of both diagonals: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/zones/shared_strains.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <vector>

namespace kaya {

/// Fills ZoneTiles::shared_faces: the outer faces of cells with Together::strains_at_points to which nothing is tied.
void find_shared_faces(const Model& model, ZoneLaws& laws);

/// Adds to the own strains of zones what these faces differ from the triangles of the zones.
void add_face_strains(const Model& model, const ZoneLaws& laws, SharedStrains& shared);

/// Adds the forces of the shared stresses at these faces that belong to those strains.
void add_face_forces(const Model& model, const ZoneLaws& laws, const SharedStrains& shared,
                     std::vector<PointRow>& forces);

} // namespace kaya
