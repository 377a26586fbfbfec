// The stress that is in the ground before anything happens.
#pragma once

#include "laws/joint_model.hpp"
#include "mechanics/boundary.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// Gives zones the stress at their centroid, and sub-contacts the forces with which that stress acts on their area:
/// with n from block 1 to block 2, -n.s.n of normal stress (compression positive) and the rest of -s.n as shear.
/// Forces beyond what a joint bears are cut by its model in the next cycle. Displacements stay as they are.
/// Contacts must have been found. `zones` and `sub_contacts` are ascending rows.
void set_insitu_stress(Model& model, JointRegistry& joints, const std::vector<Row>& zones,
                       const std::vector<Row>& sub_contacts, const StressField& stress);

/// The same with the stress that the weight above makes: szz is minus the weight per area of all blocks straight
/// above, sxx = kx szz, syy = ky szz, no shear. Throws Diagnostic as Overburden does.
void set_topography_stress(Model& model, JointRegistry& joints, const std::vector<Row>& zones,
                           const std::vector<Row>& sub_contacts, double kx, double ky);

/// Sets one component of the stress of zones to its value at their centroid; `component` counts xx yy zz xy xz yz.
void set_stress_component(Model& model, const std::vector<Row>& zones, int component, double at_origin,
                          const Vec3& gradient);

/// Gives gridpoints a pore pressure that is linear in space. From then on the water in joints comes from gridpoints; those
/// that have been given none have 0.
void set_pore_pressure(Model& model, const std::vector<Row>& gridpoints, double at_origin, const Vec3& gradient);

} // namespace kaya
