// The columns of the model's tables as arrays of numpy, without a copy.
#pragma once

#include "model/tables/model.hpp"

#include <atomic>
#include <memory>
#include <pybind11/numpy.h>
#include <string>

namespace kaya::python {

/// How many arrays that look into the model are alive.
using Borrowed = std::shared_ptr<std::atomic<std::int64_t>>;

/// {table: {column: (type of numpy, shape)}} of all tables that have rows.
pybind11::dict column_names(Model& model);

/// A read-only array of the memory of a column, of shape (rows,) or (rows, numbers of one value). It counts in `borrowed` until it and all
/// its slices are gone; until then the model must not change its rows. Throws KeyError when there is no such column.
pybind11::array column_array(Model& model, const std::string& table, const std::string& column,
                             const Borrowed& borrowed);

} // namespace kaya::python
