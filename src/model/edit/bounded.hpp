// Whether the places, motions and masses of a model are numbers that can be computed with.
#pragma once

#include "base/diagnostic.hpp"
#include "model/tables/model.hpp"

#include <string>

namespace kaya {

/// Coordinates, velocities and displacements beyond it belong to a run that has diverged. Their cubes, and products of a few of them, are
/// still finite.
inline constexpr double largest_coordinate = 1e30;

/// Whether a box, or anything else that is made of coordinates, is in that space; not-a-number is not.
template <class Coordinates> bool is_bounded(const Coordinates& coordinates) {
    return (coordinates.array().abs() <= largest_coordinate).all();
}

/// Empty when values with the roles of geometry, motion and displacement are finite, coordinates and velocities are bounded, and masses,
/// volumes and time steps are not negative; otherwise a sentence about the first invalid one: "the velocity of block 2 is ...". Called
/// after a restore, before computations with shapes, and when a run diverges.
std::string unbounded_number(Model& model);

/// Throws Diagnostic (Fault::run) with that sentence.
void require_bounded(Model& model);

/// A run that has diverged: the first such number, if there is one by now.
Diagnostic diverged(Model& model);

} // namespace kaya
