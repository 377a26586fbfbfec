// Joints, one step on: docs/theory/contacts.md.
// reads: blocks.velocity, blocks.rotational_velocity, blocks.centroid, gridpoints.velocity, gridpoints.position, sub_contacts.pore_pressure, joint_properties
// writes: contacts but for their rows, sub_contacts but for their rows
#pragma once

#include "base/per_thread.hpp"
#include "mechanics/batches.hpp"
#include "mechanics/contact_stiffness.hpp"
#include "mechanics/overlap_contact.hpp"
#include "mechanics/overlap_scratch.hpp"
#include "mechanics/phase_sums.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// What contacts pass on in a cycle; derived, so that it is not part of the model.
struct JointForces {
    std::vector<Vec3> of_sub_contact; ///< on the second side, of contacts with a deformable block
    std::vector<Vec3> of_contact;     ///< sum on the second block
    std::vector<Vec3> moment;         ///< of that sum about Contacts::position
    /// Of each contact, to be compared with that of the last step only: of a joint its sub-contacts' larger tangent stiffnesses,
    /// of an overlap what each of its blocks feels. It follows from the state: inertial masses, which density scaling changes
    /// after it was taken, have no part in it.
    std::vector<StiffnessOfSides> stiffness;
    std::vector<ContactKind> kind; ///< as it was when the stiffness was taken
    std::vector<char>
        stiffness_changed; ///< of contacts that are much stiffer or have other geometry, until someone clears it
};

/// Room for what a batch needs within a step; its memory stays.
struct JointScratch {
    BatchColumns columns, of_contact; ///< of the batch, and of one contact that begins again
    std::vector<double> friction; ///< frictional work before the step, by contact of the batch; of those with overlap
    std::vector<double> row_friction; ///< by row of the batch
    std::vector<CarriedLoad> carried; ///< by contact of the batch; of those with overlap
    OverlapScratch overlap;
};

/// Turns the planes, computes displacement increments, calls the joint models, and writes contact forces, displacements, history,
/// state and stiffnesses. One batch after another goes through all of it.
JointSums advance_joints(Model& model, const std::vector<Batch>& batches, JointForces& forces,
                         PerThread<JointScratch>& scratch);

/// Forces of the contacts as they are, without a step. Contacts with geometry made anew are marked as changed.
void joint_forces(const Model& model, JointForces& forces);

/// The same for those contacts only; the others have kept their rows and forces.
void joint_forces_of_new(const Model& model, JointForces& forces);

} // namespace kaya
