// Helpers for the tables of fields: getters and setters made from a table and a column. For the field_*.cpp files only.
#pragma once

#include "base/diagnostic.hpp"
#include "model/fields/field.hpp"
#include "model/kinds/groups.hpp"

#include <cmath>
#include <type_traits>

namespace kaya::field_rows {

using Fields = std::vector<Field>;

const Fields& global_fields();
const Fields& block_fields();
const Fields& gridpoint_fields();
const Fields& face_fields();
const Fields& zone_fields();
const Fields& contact_fields();
const Fields& sub_contact_fields();
const Fields& corner_fields();
const Fields& cable_fields();
const Fields& member_fields();

/// The number in a value that a script gives. Throws Diagnostic when it is something else.
double number(const FieldValue& value);
std::int64_t whole_number(const FieldValue& value);
Vec3 vector(const FieldValue& value);
const std::string& text(const FieldValue& value);

/// A name from 1 up for rows of tables that have no number column.
inline std::int64_t count_from_one(const Model&, Row row) { return row + 1; }

template <class T> FieldValue value_of(const T& value) {
    if constexpr (std::is_floating_point_v<T>) return static_cast<double>(value);
    else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) return static_cast<std::int64_t>(value);
    else return FieldValue(value);
}

/// A whole column: read<&Model::gridpoints, &Gridpoints::mass>.
template <auto table, auto column> FieldValue read(const Model& model, Row row) {
    return value_of(((model.*table).*column)[row]);
}
/// One component of a column of vectors or stresses.
template <auto table, auto column, int k> FieldValue read(const Model& model, Row row) {
    return ((model.*table).*column)[row][k];
}
/// A column of rows of another table.
template <auto table, auto column, ObjectKind to> FieldValue link(const Model& model, Row row) {
    return Link{to, ((model.*table).*column)[row]};
}
/// The first row of a span; an empty span links to nothing.
template <auto table, auto column, ObjectKind to> FieldValue first(const Model& model, Row row) {
    const Span span = ((model.*table).*column)[row];
    return Link{to, span.count > 0 ? span.first : no_row};
}

/// A function of the row: call<zone_volume>.
template <auto function> FieldValue call(const Model& model, Row row) { return value_of(function(model, row)); }
template <auto function, int k> FieldValue call(const Model& model, Row row) { return function(model, row)[k]; }

/// The name of the group that an object is in, itself or through its block.
template <ObjectKind kind> FieldValue read_group(const Model& model, Row row) {
    return std::string(default_group_of(model, kind, row));
}
template <ObjectKind kind> void write_group(Model& model, Row row, const FieldValue& value) {
    auto& group = (*own_groups(model, kind))[row];
    group = with_group(model, group, text(value));
}

template <class T> void assign(T& target, const FieldValue& value) {
    if constexpr (std::is_same_v<T, Vec3>) target = vector(value);
    else if constexpr (std::is_floating_point_v<T>) target = number(value);
    else target = static_cast<T>(whole_number(value));
}
template <auto table, auto column> void write(Model& model, Row row, const FieldValue& value) {
    auto& target = (model.*table).*column;
    if constexpr (std::is_same_v<std::decay_t<decltype(target)>, VectorColumn>) target.set(row, vector(value));
    else assign(target[row], value);
}
template <auto table, auto column, int k> void write(Model& model, Row row, const FieldValue& value) {
    auto& target = (model.*table).*column;
    if constexpr (std::is_same_v<std::decay_t<decltype(target)>, VectorColumn>)
        target.component[k][row] = number(value);
    else target[row][k] = number(value);
}

} // namespace kaya::field_rows
