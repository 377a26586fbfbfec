// Advances the joints by one step: docs/theory/contacts.md.
// reads: blocks.velocity, blocks.rotational_velocity, blocks.centroid, gridpoints.velocity, gridpoints.position, sub_contacts.pore_pressure, joint_properties
// writes: contacts but for their rows, sub_contacts but for their rows
#pragma once

#include "base/per_thread.hpp"
#include "mechanics/contact/batches.hpp"
#include "mechanics/contact/contact_stiffness.hpp"
#include "mechanics/contact/overlap_contact.hpp"
#include "mechanics/shape/overlap_scratch.hpp"
#include "mechanics/common/phase_sums.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Forces that contacts exert in a cycle; derived data, not part of the model.
struct JointForces {
    std::vector<Vec3> of_sub_contact; ///< on the second side, of contacts with a deformable block
    std::vector<Vec3> of_contact;     ///< sum on the second block
    std::vector<Vec3> moment;         ///< of that sum about Contacts::position
    /// By contact, for comparison with the previous step only: the larger tangent stiffnesses of a joint's sub-contacts, or the stiffness
    /// that each block of an overlap feels. It depends on the state only, not on inertial masses, which density scaling may change
    /// afterwards.
    std::vector<StiffnessOfSides> stiffness;
    std::vector<Compliance> compliance;  ///< by block
    std::vector<ContactKind> kind;       ///< when the stiffness was computed
    std::vector<char> stiffness_changed; ///< of contacts that are much stiffer or have other geometry, until cleared
};

/// Scratch memory of a batch within a step; it is reused.
struct JointScratch {
    BatchColumns columns, of_contact; ///< of the batch, and of one contact that is initialised
    std::vector<double> friction; ///< frictional work before the step, by contact of the batch; of those with overlap
    std::vector<double> row_friction;  ///< by row of the batch
    std::vector<CarriedLoad> carried;  ///< by contact of the batch; of those with overlap
    std::vector<OverlapSlopes> slopes; ///< likewise; of curved ones
    OverlapScratch overlap;

    /// Of contact `c`, the i-th of the batch; null where it is not curved.
    OverlapSlopes* slopes_of(const Model& model, std::size_t i, Row c) {
        if (model.contacts.curved[c] == 0) return nullptr;
        if (slopes.size() <= i) slopes.resize(i + 1);
        return &slopes[i];
    }
};

/// Turns the planes, computes displacement increments, calls the joint models, and writes contact forces, displacements, history, state and
/// stiffnesses. Batches are processed one after another.
JointSums advance_joints(Model& model, const std::vector<Batch>& batches, JointForces& forces,
                         PerThread<JointScratch>& scratch);

/// Computes contact forces without advancing. Contacts with updated geometry are marked as changed.
void joint_forces(const Model& model, JointForces& forces);

/// The same for contacts with new geometry only; the others have kept their rows and forces.
void joint_forces_of_new(const Model& model, JointForces& forces);

} // namespace kaya
