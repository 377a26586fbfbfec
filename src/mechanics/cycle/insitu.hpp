// Initial stress of the ground.
#pragma once

#include "laws/joint_model.hpp"
#include "mechanics/supports/boundary.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Joints whose faces do not meet, and carry a stress that they were given.
struct OpenFaces {
    Row joints = 0;
    double widest = 0; ///< gap
};

/// Gives zones the stress at their centroid, and sub-contacts the forces of that stress on their area: with n from block 1 to block 2,
/// -n.s.n of normal stress (compression positive) and the rest of -s.n as shear. Forces beyond the strength of a joint are reduced by its
/// model in the next cycle. Displacements are unchanged. Corners and edges that are apart from what they meet get no force. Contacts must be up to
/// date. `zones` and `sub_contacts` are ascending rows.
OpenFaces set_insitu_stress(Model& model, JointRegistry& joints, const std::vector<Row>& zones,
                            const std::vector<Row>& sub_contacts, const StressField& stress);

/// The same with the stress of the overburden: szz is minus the weight per area of all blocks vertically above, sxx = kx szz, syy = ky szz,
/// no shear. Throws Diagnostic as Overburden does.
OpenFaces set_topography_stress(Model& model, JointRegistry& joints, const std::vector<Row>& zones,
                                const std::vector<Row>& sub_contacts, double kx, double ky);

/// Gives sub-contacts between zones the forces of the stress there: the mean of both sides, each with the mean of its zones at the
/// gridpoints of the place, by their volume.
void set_stress_of_zones(Model& model, JointRegistry& joints, const std::vector<Row>& sub_contacts);

/// Sets one component of the stress of zones to its value at their centroid; `component` counts xx yy zz xy xz yz.
void set_stress_component(Model& model, const std::vector<Row>& zones, int component, double at_origin,
                          const Vec3& gradient);

/// Sets a pore pressure of gridpoints that is linear in position. Water in joints is then taken from gridpoints; those without a value have
/// 0.
void set_pore_pressure(Model& model, const std::vector<Row>& gridpoints, double at_origin, const Vec3& gradient);

} // namespace kaya
