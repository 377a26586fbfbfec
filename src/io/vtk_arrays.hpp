// Arrays of .vtu files from the table of fields. Internal to this folder.
#pragma once

#include "io/vtk.hpp"
#include "geometry/grid/vtu_grid.hpp"
#include "model/fields/field.hpp"
#include "model/tables/model.hpp"

#include <span>
#include <string_view>

namespace kaya {

/// An array for each field of a table, with the prefix and the name of the field, one tuple for each row. Components of vectors and of
/// stress have no separate arrays. Objects are written by their number, texts by their index in the list NAME_names. A row that is `no_row`
/// gives NaN, or -1 in arrays of whole numbers. A name that the target already has is skipped.
void add_fields(VtuArrays& target, VtuLists& lists, const Model& model, ObjectKind table, std::span<const Row> rows,
                std::string_view prefix = "");

/// jmodel_NAME for each variable that a joint model remembers of sub-contacts; NaN where a model has none of that name.
void add_own_values(VtuArrays& target, const Model& model, const OwnValues& own, std::span<const Row> rows);

} // namespace kaya
