// The order in which sub-contacts stand in their table.
#pragma once

#include "model/model.hpp"

namespace kaya {

/// Puts sub-contacts of one property set one after the other, so that a joint model gets many in one call where joint sets of
/// several materials cross. Contacts near each other in their table stay near each other: forces are gathered block by
/// block. The rows of a contact stay together. Does nothing where they stand so already.
void order_sub_contacts(Model& model);

} // namespace kaya
