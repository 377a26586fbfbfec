// The part of advance_joints in which a contact follows its blocks.
#pragma once

#include "model/lanes.hpp"
#include "model/model.hpp"

#include <cstddef>
#include <vector>

namespace kaya {

/// Rates of work on the blocks times the step, in lanes of sub-contacts.
struct JointWork {
    Lanes joint = Lanes::Zero(), friction = Lanes::Zero();
    Lanes fluid = Lanes::Zero(); ///< of the pore pressure; a joint model does not change it
    double dashpots = 0;         ///< of the viscous forces of overlaps

    void add(const JointWork& other) {
        joint += other.joint;
        friction += other.friction;
        fluid += other.fluid;
        dashpots += other.dashpots;
    }
};

/// Turns the plane of a contact with its blocks and writes the displacement increments of its
/// sub-contacts; turns their shear forces with the plane. Adds the work of the forces as they then are to `work`.
void move_contact(Model& model, Row contact, JointWork& work);

/// Turns the vectors that a joint model keeps of each sub-contact as its shear force was turned: `vectors` has the first
/// of the three history variables of each. Only where strain is large; call it after move_contact.
void turn_kept_vectors(Model& model, Row contact, const std::vector<std::size_t>& vectors);

} // namespace kaya
