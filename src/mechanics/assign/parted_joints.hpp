// Joints that come between the parts of a rigid body when it is cut or its blocks are separated: docs/theory/contacts.md.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Finds the contacts, and gives the joints between the parts of each body the forces that were within it: those with which every part moves
/// on as the body did under all other forces, of contacts, loads, weights and structures. Between more parts than statics can tell, they are
/// those of springs of one stiffness per area. `bodies`: blocks that were one body each. Bodies on which no other body acts yet, with zones or
/// with a prescribed velocity are left out.
void load_parted_joints(Model& model, JointRegistry& joints, const std::vector<std::vector<Row>>& bodies);

} // namespace kaya
