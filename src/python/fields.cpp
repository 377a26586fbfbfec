#include "python/fields.hpp"

#include "mechanics/assign/contact_properties.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

namespace kaya::python {

namespace py = pybind11;

namespace {

const Field& field_of(ObjectKind kind, const std::string& name) {
    if (const Field* field = find_any_field(kind, name)) return *field;
    const auto shown = kind == ObjectKind::global ? std::string("model") : std::string(info_of(kind).name);
    throw py::key_error("a " + shown + " has no field '" + name + "'; fields() lists them");
}

py::object as_object(const Model& model, const FieldValue& value) {
    return std::visit(
        [&model](const auto& one) -> py::object {
            using T = std::decay_t<decltype(one)>;
            if constexpr (std::is_same_v<T, Vec3>) return py::array_t<double>(3, one.data());
            else if constexpr (std::is_same_v<T, Link>) {
                const auto number = object_number(model, one);
                return number ? py::cast(*number) : py::none();
            } else return py::cast(one);
        },
        value);
}

template <class Number, class Take> py::array_t<Number> numbers(std::size_t rows, const Take& take) {
    py::array_t<Number> array(static_cast<py::ssize_t>(rows));
    Number* to = array.mutable_data();
    for (std::size_t row = 0; row < rows; ++row) to[row] = take(static_cast<Row>(row));
    return array;
}

/// The type of the values of a field is that of its first row.
py::object values_of(const Model& model, const Field& field, std::size_t rows) {
    if (rows == 0) return py::array_t<double>(0);
    const auto get = [&](Row row) { return field.get(model, row); };
    const FieldValue first = get(0);
    if (std::holds_alternative<Vec3>(first)) {
        py::array_t<double> array({static_cast<py::ssize_t>(rows), py::ssize_t{3}});
        double* to = array.mutable_data();
        for (std::size_t row = 0; row < rows; ++row) {
            const FieldValue value = get(static_cast<Row>(row));
            for (const double part : std::get<Vec3>(value)) *to++ = part;
        }
        return array;
    }
    if (std::holds_alternative<std::string>(first)) {
        py::list texts(rows);
        for (std::size_t row = 0; row < rows; ++row) texts[row] = std::get<std::string>(get(static_cast<Row>(row)));
        return texts;
    }
    if (std::holds_alternative<Link>(first))
        return numbers<std::int64_t>(rows, [&](Row row) -> std::int64_t { return std::get<Link>(get(row)).row; });
    if (std::holds_alternative<std::int64_t>(first))
        return numbers<std::int64_t>(rows, [&](Row row) { return std::get<std::int64_t>(get(row)); });
    return numbers<double>(rows, [&](Row row) { return std::get<double>(get(row)); });
}

FieldValue given_value(const py::handle& value) {
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::isinstance<py::int_>(value)) return value.cast<std::int64_t>();
    if (py::isinstance<py::float_>(value)) return value.cast<double>();
    if (py::len(value) != 3) throw py::value_error("a vector has three components");
    Vec3 vector;
    for (int k = 0; k < 3; ++k) vector[k] = value[py::int_(k)].cast<double>();
    return vector;
}

} // namespace

ObjectKind kind_of(const std::string& name) {
    if (const auto kind = find_kind(name)) return *kind;
    throw py::key_error("there are no objects of a kind '" + name + "'");
}

std::size_t count_objects(Session& session, const std::string& kind) {
    const auto& info = info_of(kind_of(kind));
    if (info.found_late && !session.engine.inside_cycle) find_contacts(session.engine.model, session.engine.joints);
    return info.count(session.engine.model);
}

std::vector<std::string> kind_names() {
    std::vector<std::string> names;
    for (const auto& info : kinds())
        if (info.kind < end_of_script_kinds) names.emplace_back(info.name);
    return names;
}

py::list field_names(const std::string& name) {
    const ObjectKind kind = kind_of(name);
    py::list all;
    for (const auto& field : fields())
        if (field.kind == kind)
            all.append(
                py::make_tuple(field.name, field.unit, field.help, field.classic, field.modern, field.set != nullptr));
    return all;
}

py::object field_values(Session& session, const std::string& kind, const std::string& name) {
    const Field& field = field_of(kind_of(kind), name);
    return values_of(session.engine.model, field, count_objects(session, kind));
}

void set_field(Session& session, const std::string& kind, const std::string& name,
               const py::array_t<std::int64_t>& rows, const py::object& values) {
    const Field& field = field_of(kind_of(kind), name);
    if (field.set == nullptr) throw Diagnostic("the field '" + name + "' is for reading only");
    const auto count = static_cast<std::int64_t>(count_objects(session, kind));
    const std::int64_t* row = rows.data();
    if (std::any_of(row, row + rows.size(), [count](std::int64_t r) { return r < 0 || r >= count; }))
        throw py::index_error("a row is outside of 0 to " + std::to_string(count - 1));
    const bool each = py::isinstance<py::list>(values);
    if (each && py::len(values) != static_cast<std::size_t>(rows.size()))
        throw py::value_error(std::to_string(py::len(values)) + " values for " + std::to_string(rows.size()) + " rows");
    for (py::ssize_t k = 0; k < rows.size(); ++k)
        field.set(session.engine.model, static_cast<Row>(row[k]),
                  given_value(each ? py::object(values[py::int_(k)]) : values));
}

script::Handle handle_of(Session& session, const std::string& kind, std::size_t row) {
    const std::size_t count = count_objects(session, kind);
    if (row >= count)
        throw py::index_error("there is no row " + std::to_string(row) + ": there are " + std::to_string(count));
    return session.engine.world.at(static_cast<std::int32_t>(kind_of(kind)), row);
}

std::optional<script::Handle> nearest_object(Session& session, const std::string& kind, const Vec3& place) {
    if (count_objects(session, kind) == 0) return std::nullopt;
    return session.engine.world.nearest(kind_of(kind), place);
}

py::object global_value(Session& session, const std::string& name) {
    return as_object(session.engine.model, field_of(ObjectKind::global, name).get(session.engine.model, 0));
}

} // namespace kaya::python
