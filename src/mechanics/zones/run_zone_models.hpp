// Advances zones by one step: docs/theory/zones.md.
// reads: gridpoints.position, gridpoints.velocity, gridpoints.pore_pressure, zone_properties, clock.time_step
// writes: zones.stress, zones.state, zones.history, zones.dashpot
#pragma once

#include "mechanics/common/phase_sums.hpp"
#include "mechanics/zones/cell_stresses.hpp"
#include "mechanics/zones/shared_strains.hpp"
#include "mechanics/zones/zone_tiles.hpp"
#include "model/tables/model.hpp"

#include <exception>
#include <vector>

namespace kaya {

class ZoneLaws;

/// Scratch memory of zones within a step, and of cells between steps; it is reused.
struct ZoneScratch {
    /// By zone: volume strain, its mean, what flow changes of the mean stress and of the viscous one.
    std::vector<double> volume, strain, mean_strain, flow, viscous_flow;
    std::vector<PointMean<1>> at_point; ///< by point of the tiles
    SharedStrains shared;
    std::vector<double> pressure; ///< of the pores, by gridpoint; empty where there is no water
    CellStresses cells;
};

/// Preparations before the zones of a step.
void begin_zones(Model& model, const ZoneLaws& laws, ZoneScratch& scratch);

/// Whether the zones of a tile depend on no gridpoint but their own.
bool tiles_go_alone(const Model& model, const ZoneLaws& laws);

/// The result of a tile. A failure is kept until all tiles have run, so that what they leave does not depend on the number of threads.
struct TileResult {
    ZoneSums sums;
    std::exception_ptr failure;
};

/// Runs the zones of one tile, if tiles are independent, after begin_zones.
TileResult run_tile(Model& model, const ZoneLaws& laws, const ZoneTile& tile, ZoneScratch& scratch,
                    std::vector<PointRow>& forces);

/// Also writes `forces`: by point of the tiles, with the sum of the magnitudes of the forces of single zones. Throws Diagnostic when a zone
/// model fails, or a zone has no volume: that of the first tile.
ZoneSums run_zone_models(Model& model, const ZoneLaws& laws, ZoneScratch& scratch, std::vector<PointRow>& forces);

/// Forces of the present stresses, without a step.
void zone_forces(const Model& model, const ZoneLaws& laws, std::vector<PointRow>& forces);

} // namespace kaya
