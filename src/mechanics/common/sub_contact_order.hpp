// The order of sub-contacts in their table.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Makes sub-contacts of one property set consecutive, so that a joint model gets many in one call where joint sets of several materials
/// cross. Near contacts remain near each other in the table: forces are gathered block by block. The rows of a contact stay together. Does
/// nothing if the order is already right.
void order_sub_contacts(Model& model);

} // namespace kaya
