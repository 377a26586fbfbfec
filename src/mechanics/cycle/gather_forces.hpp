// Forces on bodies, gathered in the order of rows.
// reads: contacts.position, gridpoints.load, blocks.load, blocks.torque, ties.force, structures, settings.gravity
// writes: blocks.force, blocks.moment, gridpoints.force, clock.unbalanced_force, clock.average_ratio, clock.maximum_ratio, clock.local_ratio
#pragma once

#include "mechanics/bodies/adjacency.hpp"
#include "mechanics/contact/advance_joints.hpp"
#include "mechanics/structures/member_lists.hpp"
#include "mechanics/zones/zone_tiles.hpp"
#include "model/tables/model.hpp"

#include <algorithm>
#include <vector>

namespace kaya {

class TieLists;

/// Unbalanced forces of free bodies relative to the forces that act on them.
struct Balance {
    double largest = 0;     ///< unbalanced force of one body
    double unbalanced = 0;  ///< sum over bodies
    double applied = 0;     ///< sum over bodies of the magnitudes of all forces on them
    double local_ratio = 0; ///< largest unbalanced over applied of one body
    std::size_t bodies = 0;
    double inner_power = 0; ///< of the forces of joints and zones

    void add(const Vec3& force, double acting) { add(force.norm(), acting); }
    void add(double size, double acting) {
        largest = std::max(largest, size);
        unbalanced += size;
        applied += acting;
        if (acting > 0) local_ratio = std::max(local_ratio, size / acting);
        ++bodies;
    }
};

/// Forces on gridpoints in addition to their loads and weights.
struct PointForces {
    const Adjacency& adjacency;
    const TieLists& ties;
    const JointForces& joints;
    const ZoneTiles& tiles;
    const std::vector<PointRow>& zone_forces; ///< by point of the tiles
};

/// Gridpoints of deformable blocks, chunk by chunk.
class ForceGathering {
public:
    static constexpr std::size_t grain = 512; ///< gridpoints in a chunk

    ForceGathering(Model& model, const PointForces& forces) : model_(model), forces_(forces) {}

    /// Writes the forces of a chunk, except for tied gridpoints.
    Balance gather(std::size_t first, std::size_t last);
    /// Whether only zones act in a chunk.
    bool only_zones_act(std::size_t first, std::size_t last) const;

private:
    Model& model_;
    const PointForces& forces_;
};

/// Chunks of gridpoints whose forces were gathered early in this step.
struct GatheredChunks {
    std::vector<char> done; ///< empty: none
    std::vector<Balance> balance;

    void forget() { std::ranges::fill(done, 0); }
};

/// Sums the forces of contacts, zones, ties and structures. Returns the power of the forces of joints and zones on the bodies.
double gather_forces(Model& model, const PointForces& forces, const MemberLists& members,
                     const GatheredChunks& gathered = {});

} // namespace kaya
