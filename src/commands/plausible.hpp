// What a deck may well say and hardly means: one warning each, and the run goes on.
#pragma once

#include "lang/commands/commands.hpp"

#include <vector>

namespace kaya {

class Session;

/// An angle of friction that looks like radians.
void doubt_angles(Session& session, const std::vector<lang::Property::Item>& items);
/// Poisson's ratios below 0 of materials that blocks have.
void doubt_elasticity(Session& session);
/// Damping that takes all force away from what moves.
void doubt_damping(Session& session, const lang::Damp& command);
/// A run in which nothing can move.
void doubt_empty_model(Session& session, const Place& place);

} // namespace kaya
