// Faces of cells that are ruled surfaces, those between two cells and outer ones: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/ties/ties.hpp"
#include "mechanics/zones/zone_laws.hpp"

namespace kaya {

/// Fills ZoneTiles::ruled and ZoneTiles::outer: faces of cells whose four corners also belong to another cell, in the same block or tied
/// exactly, and outer faces to which nothing is tied.
void find_ruled_faces(const Model& model, const TieLists& ties, ZoneLaws& laws);

} // namespace kaya
