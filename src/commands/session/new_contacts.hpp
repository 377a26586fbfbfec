// Contacts that are found, and the material table that gives new ones their joint models.
#pragma once

#include "commands/session/session.hpp"

namespace kaya {

/// Finds contacts. New ones get what the first entry of the material table says that picks them.
void find_joints(Session& session);

/// The same for contacts that a cycle has found.
void follow_material_table(Session& session);

} // namespace kaya
