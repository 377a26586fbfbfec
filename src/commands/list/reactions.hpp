// Forces of the supports of bodies.
#pragma once

#include "model/tables/model.hpp"

#include <functional>
#include <span>
#include <vector>

namespace kaya {

/// The supports of a group: rigid blocks and gridpoints of zones whose velocity is prescribed in some direction.
struct Reaction {
    std::int32_t group = 0;     ///< number of a group of the default slot, 0 is none
    std::size_t held = 0;       ///< blocks with a support
    Vec3 force = Vec3::Zero();  ///< that holds them: minus the held components of all other forces, own weight included
    Vec3 weight = Vec3::Zero(); ///< of the held blocks
};

struct Reactions {
    std::vector<Reaction> groups;
    Vec3 reaction = Vec3::Zero();   ///< of all supports
    Vec3 weight = Vec3::Zero();     ///< of all bodies, beams and liners
    Vec3 load = Vec3::Zero();       ///< on all bodies
    Vec3 unbalanced = Vec3::Zero(); ///< sum of reactions, weights and loads: what moves the free bodies
};

/// From the forces of the last cycle. `groups` has the supports of blocks that are picked, the sums have all.
Reactions reactions_of(const Model& model, const std::function<bool(Row block)>& picked);

/// The force of the supports on a rigid body, of one block or of all that are joined: minus the held components of all other forces.
Vec3 reaction_on(const Model& model, std::span<const Row> members);
/// The same of a gridpoint of zones.
Vec3 reaction_on_gridpoint(const Model& model, Row gridpoint);

} // namespace kaya
