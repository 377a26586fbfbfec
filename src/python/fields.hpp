// The fields of objects (docs/fields.md) as arrays of numpy, copied.
#pragma once

#include "commands/session/session.hpp"

#include <optional>
#include <pybind11/numpy.h>
#include <string>
#include <vector>

namespace kaya::python {

/// The kind of that name: "block", "sub_contact". Throws KeyError.
ObjectKind kind_of(const std::string& name);

/// The kinds that scripts see.
std::vector<std::string> kind_names();

/// Contacts are searched when there are none yet.
std::size_t count_objects(Session& session, const std::string& kind);

/// [(name, unit, help, classic FISH, newer FISH, can be set)] of a kind, or of "model".
pybind11::list field_names(const std::string& kind);

/// A field of all objects of a kind, in the order of rows: shape (rows,) of float64 or int64, (rows, 3) for vectors; a list of texts;
/// rows of the linked table as int64, -1 for none. Throws KeyError, Diagnostic.
pybind11::object field_values(Session& session, const std::string& kind, const std::string& field);

/// Sets a field of the rows given. `values` is one value for all, or one for each row. Throws Diagnostic where the field or the value does
/// not allow it; rows before that one are set.
void set_field(Session& session, const std::string& kind, const std::string& field,
               const pybind11::array_t<std::int64_t>& rows, const pybind11::object& values);

/// An object by its row: it stays the same object while others are made and deleted. Throws IndexError.
script::Handle handle_of(Session& session, const std::string& kind, std::size_t row);
/// The object that is nearest to a place, as block.near of FISH; none where there is none.
std::optional<script::Handle> nearest_object(Session& session, const std::string& kind, const Vec3& place);

/// A quantity of the whole model.
pybind11::object global_value(Session& session, const std::string& name);

} // namespace kaya::python
