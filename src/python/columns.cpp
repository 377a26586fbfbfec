#include "python/columns.hpp"

#include "model/whole/archive.hpp"

#include <optional>
#include <pybind11/stl.h>
#include <type_traits>
#include <vector>

namespace kaya::python {

namespace py = pybind11;

namespace {

py::dtype type_of(Scalar type) {
    switch (type) {
    case Scalar::boolean: return py::dtype::of<bool>();
    case Scalar::uint8: return py::dtype::of<std::uint8_t>();
    case Scalar::int32: return py::dtype::of<std::int32_t>();
    case Scalar::uint32: return py::dtype::of<std::uint32_t>();
    case Scalar::int64: return py::dtype::of<std::int64_t>();
    case Scalar::uint64: return py::dtype::of<std::uint64_t>();
    case Scalar::float64: break;
    }
    return py::dtype::of<double>();
}

std::vector<py::ssize_t> shape_of(const Numbers& column) {
    const auto rows = static_cast<py::ssize_t>(column.rows), each = static_cast<py::ssize_t>(column.each);
    return each == 1 ? std::vector{rows} : std::vector{rows, each};
}

/// Calls see(table, column, numbers) for each column whose memory is plain numbers.
template <class See> void walk_columns(Model& model, const See& see) {
    const auto walk = [&see](const char* table, auto& rows) {
        rows.columns([&](std::string_view column, auto& values, auto) {
            using Value = typename std::decay_t<decltype(values)>::value_type;
            if constexpr (!std::is_same_v<Value, Attachment> && !std::is_same_v<Value, JointObject>)
                see(std::string(table), column, numbers_of(values));
        });
    };
    model.tables(walk);
    model.structure_tables(walk);
}

} // namespace

py::dict column_names(Model& model) {
    py::dict tables;
    walk_columns(model, [&tables](const std::string& table, std::string_view column, const Numbers& numbers) {
        if (!tables.contains(table)) tables[table.c_str()] = py::dict();
        py::cast<py::dict>(tables[table.c_str()])[py::str(std::string(column))] =
            py::make_tuple(type_of(numbers.type), py::tuple(py::cast(shape_of(numbers))));
    });
    return tables;
}

py::array column_array(Model& model, const std::string& table, const std::string& column, const Borrowed& borrowed) {
    std::optional<Numbers> found;
    walk_columns(model, [&](const std::string& in, std::string_view name, const Numbers& numbers) {
        if (in == table && name == column) found = numbers;
    });
    if (!found) throw py::key_error("there is no column '" + column + "' of a table '" + table + "'");
    ++*borrowed;
    const py::capsule token(new Borrowed(borrowed), [](void* count) {
        --**static_cast<Borrowed*>(count);
        delete static_cast<Borrowed*>(count);
    });
    py::array array(type_of(found->type), shape_of(*found), found->first, token);
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

} // namespace kaya::python
