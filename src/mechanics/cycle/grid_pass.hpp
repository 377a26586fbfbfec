// Advances gridpoints and their zones in one pass: the work of move_bodies.hpp, run_zone_models.hpp and gather_forces.hpp, chunk by chunk
// and tile by tile, while their rows are in the cache.
// reads: gridpoints.force, gridpoints.load, gridpoints.inertial_mass, gridpoints.mass, zone_properties, settings, clock.time_step
// writes: gridpoints.velocity, gridpoints.position, gridpoints.displacement, gridpoints.last_force, blocks.travelled, zones.stress, zones.state, zones.history, zones.dashpot, gridpoints.force, blocks.force
#pragma once

#include "mechanics/cycle/gather_forces.hpp"
#include "mechanics/common/phase_sums.hpp"
#include "mechanics/supports/quiet_boundary.hpp"
#include "mechanics/zones/run_zone_models.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <vector>

namespace kaya {

/// The sums equal those of the separate phases to the last bit: they are added over the same chunks and tiles, in their order.
class GridPass {
public:
    GridPass() = default;
    /// For `threads` threads.
    GridPass(const Model& model, const ZoneTiles& tiles, int threads);

    int threads() const { return threads_; }

    /// Whether no phase must wait for all gridpoints or all zones.
    static bool possible(const Model& model, const ZoneLaws& laws, const TieLists& ties);

    /// With constant loads, chunks on which only zones act are gathered too. Writes `zone_forces` as run_zone_models does. Throws
    /// Diagnostic when a zone model fails.
    void run(Model& model, const QuietPoints& quiet, const ZoneLaws& laws, ZoneScratch& scratch,
             const PointForces& forces, bool loads_stay, std::vector<PointRow>& zone_forces);

    const MotionSums& motion() const { return motion_; }
    const ZoneSums& zones() const { return zones_; }
    /// The chunks gathered in this step; empty after they are invalidated, for example by new contacts.
    const GatheredChunks& gathered() const { return gathered_; }
    void forget_gathered() { gathered_.forget(); }

private:
    enum class Work { move, zones, gather };
    struct Step {
        Work work;
        Row index; ///< of a chunk of moving gridpoints, of a tile, or of a chunk whose forces are gathered
    };

    void add_up();

    int threads_ = 0;
    Lists<Step> steps_; ///< by thread
    std::vector<Row> late_tiles_,
        late_chunks_; ///< with gridpoints that several threads move, and those that they act on
    std::vector<MotionSums> chunks_;
    std::vector<TileResult> tiles_;
    MotionSums motion_;
    ZoneSums zones_;
    GatheredChunks gathered_;
};

} // namespace kaya
