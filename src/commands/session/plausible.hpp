// Valid but implausible statements of a deck: one warning each, and the run continues.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/commands/commands.hpp"

#include <vector>

namespace kaya {

class Session;

/// Shows the doubts that the text of a command raises (review/text_doubts.hpp) as warnings.
void warn_of(Session& session, std::vector<Diagnostic> doubts);
/// Angles of friction that look like radians.
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
/// Words of `prop mat` that joint models took, where zones have a property of this name and keep its initial value.
void doubt_zone_words(Session& session);
/// Zones that shrink to nothing under their weight, or carry waves faster than any solid.
void doubt_zone_magnitudes(Session& session);
/// Joints across which the water ends, where sub-contacts miss its force by a part of a block's weight.
void doubt_water_lines(Session& session);
/// Damping that brings models to rest, in dynamic runs to a time: a note.
void doubt_dynamic_damping(Session& session);
/// Undamped motion, which does not end in equilibrium.
void doubt_undamped_search(Session& session, const Place& place);
/// Blocks that have left all others while cycles were counted.
void doubt_gone_blocks(Session& session, const Place& place);
/// A search for equilibrium where no force acts and nothing moves.
void doubt_idle_model(Session& session, const Place& place);
/// A run in which nothing can move.
void doubt_empty_model(Session& session, const Place& place);

} // namespace kaya
