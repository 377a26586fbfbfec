// Strains and stresses of flowing zones as means of their neighbourhood: docs/theory/slopes.md, "Shared strains".
#pragma once

#include "mechanics/zones/point_means.hpp"
#include "model/tables/model.hpp"

#include <array>
#include <vector>

namespace kaya {

/// Scratch memory, by zone; only zones of `Together::strains_at_points` have values.
struct SharedStrains {
    using Six = std::array<double, 6>; ///< xx, yy, zz, xy, xz, yz
    std::vector<double> volume;
    std::vector<Six> own, strain,
        stress; ///< strain of the step, its mean, and the stress whose forces act on the gridpoints
    std::vector<PointMean<6>> at_point; ///< by point of the tiles
};

/// Volumes, strains of the step and their means.
void share_strains(const Model& model, const ZoneLaws& laws, SharedStrains& shared);

/// Means of the present effective stresses, with the same weights: their forces do the work that the zones' own stresses do on the means of
/// the strains. The pore pressure, by gridpoint and empty where there is no water, is not averaged. Follows share_strains.
void share_stresses(const Model& model, const ZoneLaws& laws, const std::vector<double>& pressure,
                    SharedStrains& shared);

} // namespace kaya
