// The part of advance_joints in which a contact follows its blocks.
#pragma once

#include "mechanics/contact/contact_work.hpp"
#include "mechanics/contact/pair_motions.hpp"
#include "model/tables/model.hpp"

#include <cstddef>
#include <vector>

namespace kaya {

/// Turns the plane of a contact with its blocks, writes the displacement increments of its sub-contacts, and turns their shear forces and
/// the vectors that a joint model keeps with the plane: `kept` holds the index of the first of the three history variables of each vector.
/// Adds the work of the present forces to `work`. For contacts of deformable blocks.
void move_contact(Model& model, Row contact, const std::vector<std::size_t>& kept, JointWork& work);

/// The same for a joint between rigid blocks, number `lane` of the prepared pairs.
void move_rigid_contact(Model& model, Row contact, const PairMotions& pairs, std::size_t lane,
                        const std::vector<std::size_t>& kept, JointWork& work);

/// Turns only the vectors of a contact that has moved. Does nothing in small strain.
void turn_kept_vectors(Model& model, Row contact, const std::vector<std::size_t>& kept);

} // namespace kaya
