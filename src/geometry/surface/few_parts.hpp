// A concave body as few convex parts that are nearly the body.
#pragma once

#include "geometry/polyhedra/polyhedron.hpp"

#include <vector>

namespace kaya {

/// At most `most` convex parts for the body that these convex parts fill: planes divide it where that saves most volume, and each piece becomes its
/// hull. Hulls on two sides of a plane share no volume; together they hold the body, and more where it is hollow. The parts themselves when
/// they are no more.
std::vector<Polyhedron> few_convex_parts(const std::vector<Polyhedron>& parts, std::size_t most);

} // namespace kaya
