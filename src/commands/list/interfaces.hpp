// The force between two bodies, summed over all of their contacts.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <optional>
#include <vector>

namespace kaya {

/// The contacts of two bodies. A body is a block, or joined blocks, which count as the one with the lowest number.
struct Interface {
    Row first = no_row, second = no_row; ///< blocks, the one with the lower number first
    std::vector<Row> contacts;
    double area = 0;
    Vec3 normal = Vec3::Zero(); ///< mean by area, unit, from the first to the second
    Vec3 force = Vec3::Zero();  ///< of the first on the second, with pressure of water and dashpots
    Vec3 moment = Vec3::Zero(); ///< of that force about `centre`
    Vec3 centre = Vec3::Zero(); ///< mean of the places of the contacts by area

    double normal_force() const { return force.dot(normal); } ///< compression positive
    double shear_force() const { return (force - normal_force() * normal).norm(); }
    /// Where the line of the force passes through the plane of the interface; the centre where it runs along the plane or there is none.
    Vec3 point_of_action() const;
};

/// The shear force over what friction, at the force that the joint model sees beside water, and cohesion can take; of sub-contacts that have
/// failed, what is left of both. None where a joint model has no friction or the interface can take none.
std::optional<double> utilisation_of(const Model& model, const JointRegistry& joints, const Interface& one);

/// The interfaces of these contacts, by the numbers of their blocks.
std::vector<Interface> interfaces_of(const Model& model, const std::vector<Row>& contacts);

} // namespace kaya
