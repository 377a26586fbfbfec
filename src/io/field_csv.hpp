// Objects of the model as tables: all of their fields.
#pragma once

#include "base/units.hpp"
#include "model/fields/field.hpp"

#include <span>
#include <string>

namespace kaya {

/// The kinds of objects that are exported as tables; KindInfo::file is the name of the file.
std::span<const ObjectKind> exported_kinds();

/// One row for each object, one column for each field; the header has the names of the fields, and their units if there is a system of
/// them. Vectors are given by their components, objects
/// by their numbers, an empty cell where there is none. Numbers have the fewest digits that preserve the bits.
std::string field_csv(const Model& model, ObjectKind kind, const Units& units);

/// The description of the columns: table, field, kind of quantity or its unit, help.
std::string field_list_csv(const Units& units);

} // namespace kaya
