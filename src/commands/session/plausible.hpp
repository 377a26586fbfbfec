// Valid but implausible statements of a deck: one warning each, and the run continues.
#pragma once

#include "lang/commands/commands.hpp"

#include <vector>

namespace kaya {

class Session;

/// An angle of friction that looks like radians.
void doubt_angles(Session& session, const std::vector<lang::Property::Item>& items);
/// Poisson's ratios below 0 of materials that blocks have.
void doubt_elasticity(Session& session);
/// Densities that nothing has.
void doubt_densities(Session& session);
/// Densities that no rock has in any system of units with this gravity.
void doubt_weight(Session& session);
/// Loads far above the weight of the model.
void doubt_loads(Session& session);
/// Weight that pulls up: a note, since some models count depth downwards.
void doubt_gravity(Session& session, const Vec3& gravity, const Place& place);
/// Values that no rock or stone has in the units that the deck names (`set units`).
void doubt_units(Session& session);
/// Joints that dilate more than they resist, that are too stiff for the digits of a place, whose walls are weaker than the weight of the
/// model, or whose stiffnesses or strengths do not go together: properties of contacts, when these have them.
void doubt_joints(Session& session);
/// Zone models that need a strength and have none.
void doubt_zone_strengths(Session& session);
/// Zones that shrink to nothing under their weight, or carry waves faster than any solid.
void doubt_zone_magnitudes(Session& session);
/// Planes that dip by less than 0 or more than 90 degrees, directions beyond a full turn, angles that look like radians.
void doubt_dip(Session& session, double dip, double direction, const Place& place);
/// Stresses in the ground that pull in all directions.
void doubt_tension(Session& session, const lang::InSitu& command);
/// A limit that is met before the first cycle.
void doubt_ratio(Session& session, double ratio, const Place& place);
/// Undamped motion, which does not end in equilibrium.
void doubt_undamped_search(Session& session, const Place& place);
/// Blocks that have left all others while cycles were counted.
void doubt_gone_blocks(Session& session, const Place& place);
/// A search for equilibrium where no force acts and nothing moves.
void doubt_idle_model(Session& session, const Place& place);
/// Damping that removes all force from moving bodies.
void doubt_damping(Session& session, const lang::Damp& command);
/// A run in which nothing can move.
void doubt_empty_model(Session& session, const Place& place);

} // namespace kaya
