// The part of advance_joints in which a contact follows its blocks.
#pragma once

#include "mechanics/pair_motions.hpp"
#include "model/model.hpp"

#include <cstddef>
#include <vector>

namespace kaya {

/// Rates of work on the blocks times the step, in eights of sub-contacts.
struct JointWork {
    Eight joint{}, friction{};
    Eight fluid{};       ///< of the pore pressure; a joint model does not change it
    double dashpots = 0; ///< of the viscous forces of overlaps

    void add(const JointWork& other) {
        joint += other.joint;
        friction += other.friction;
        fluid += other.fluid;
        dashpots += other.dashpots;
    }
};

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
