// Block quality: numbers that identify blocks that will cause problems, and what to do about them.
#pragma once

#include "geometry/polyhedra/polyhedron.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Shape measures of a block. Lengths in the model's unit.
struct BlockQuality {
    double volume = 0;    ///< below 0 when the faces look inward
    double extent = 0;    ///< greatest distance between two vertices
    double thickness = 0; ///< least distance between a face and the vertex farthest from it
    double width = 0;     ///< middle edge of the brick with the same second moments
    double shortest_edge = 0, longest_edge = 0;
    double smallest_face = 0; ///< area
    double worst_warp = 0;    ///< greatest distance of a vertex from the plane of its face
    double worst_bulge = 0;   ///< greatest distance of a vertex outside the plane of another face
    int open_edges = 0;       ///< edges that do not belong to exactly two faces of opposite direction
};

BlockQuality block_quality(const Polyhedron& polyhedron);

/// Limits beyond which a block is called ill.
struct QualityLimits {
    double tiny = 1e-4;   ///< volume over the mean volume of all blocks
    double thin = 0.02;   ///< thickness over extent of a plate
    double needle = 0.05; ///< width over extent of a needle
    double edge = 1e-3;   ///< shortest edge over extent
    double warp = 1e-6;   ///< warp over extent
    double bulge = 1e-6;  ///< bulge over extent
};

enum class Ailment { open, inverted, concave, warped, tiny, needle, thin, short_edge };

std::string_view name_of(Ailment ailment);    ///< one word for a table
std::string_view remedy_for(Ailment ailment); ///< one sentence: the effect and the remedy

/// Defects of a block, the most serious first; none for a good one.
std::vector<Ailment> ailments_of(const BlockQuality& quality, double mean_volume, const QualityLimits& limits = {});

/// Pairs of overlapping blocks: boxes overlap and more than `share` of the smaller volume is common. Equal blocks have a share of 1.
struct OverlappingBlocks {
    int first = 0, second = 0; ///< places in the list, first < second
    double share = 0;          ///< common volume over the smaller volume
};
std::vector<OverlappingBlocks> overlapping_blocks(const std::vector<Polyhedron>& blocks, double share = 1e-3);

} // namespace kaya
