// Ground surfaces that decks name by their files.
#pragma once

#include "commands/session/session.hpp"
#include "geometry/ground/ground.hpp"

namespace kaya {

/// Reads the surface and moves it. Throws Diagnostic with the place.
Ground ground_of(Session& session, const std::string& file, const Vec3& shift, const Place& place);

} // namespace kaya
