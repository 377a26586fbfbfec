// Groups: names by which ranges find objects. Blocks, faces, zones and contacts may each be in one.
#pragma once

#include "model/selection.hpp"

#include <cstdint>
#include <string_view>

namespace kaya {

/// Index into Model::group_names, ignoring case. -1: no such group.
std::int32_t find_group(const Model& model, std::string_view name);

/// The same; a name that is new becomes a group. The empty name is 0, no group.
std::int32_t make_group(Model& model, std::string_view name);

/// The column with the groups of objects of that kind; null when the kind has none.
Column<std::int32_t>* own_groups(Model& model, ObjectKind kind);
const Column<std::int32_t>* own_groups(const Model& model, ObjectKind kind);

/// The group of an object itself, else that of its block. Of a contact only its own; of a sub-contact that of its
/// contact.
std::int32_t group_of(const Model& model, ObjectKind kind, Row row);

} // namespace kaya
