// Arrows and crosses at places of the last state: displacements, velocities, forces of contacts, principal stresses.
#pragma once

#include "model/tables/model.hpp"

#include <string>

namespace kaya {

/// A JSON list; a set of marks that has none is left out. `centre` is the origin of places.
std::string marks_json(const Model& model, const Vec3& centre);

} // namespace kaya
