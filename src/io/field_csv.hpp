// Objects of the model as tables: all of their fields.
#pragma once

#include "model/field.hpp"

#include <string>
#include <vector>

namespace kaya {

struct FieldTableName {
    FieldTable table;
    const char* name; ///< "sub-contacts"
};

/// The tables of objects, by the names of their files.
const std::vector<FieldTableName>& field_table_names();

/// One row for each object, one column for each field; the header has the names of the fields. Vectors are given by their components, objects
/// by their numbers, an empty cell where there is none. Numbers have the fewest digits that give back the same bits.
std::string field_csv(const Model& model, FieldTable table);

/// What the columns are: table, field, kind of quantity, help.
std::string field_list_csv();

} // namespace kaya
