// Networks of fractures by name, and the fractures that a command chooses.
#pragma once

#include "commands/session/session.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "lang/commands/commands.hpp"

#include <array>
#include <optional>
#include <vector>

namespace kaya {

/// Throws Diagnostic at the place when there is none of that name, which is in lower case.
Network& network_named(SurfaceSets& sets, const std::string& name, const Place& place);

/// Whether a choice takes the fracture of one of its networks.
bool chosen(const lang::FractureChoice& choice, const Fracture& fracture);

/// The networks that a choice is about. Throws Diagnostic at the place when there is none of its name.
std::vector<Network*> networks_of(SurfaceSets& sets, const lang::FractureChoice& choice, const Place& place);

/// Copies of the chosen fractures.
Network chosen_fractures(SurfaceSets& sets, const lang::FractureChoice& choice, const Place& place);

/// The box of six bounds, or that around the model. Throws Diagnostic with the word of the bounds.
Box box_given(const Session& session, const std::optional<std::array<double, 6>>& bounds, const char* word,
              const Place& place);

} // namespace kaya
