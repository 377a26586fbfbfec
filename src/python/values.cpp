#include "python/values.hpp"

#include "lang/script/values/value_text.hpp"

#include <pybind11/stl.h>

namespace kaya::python {

namespace py = pybind11;

py::object from_script(Session& session, const script::Value& value) {
    if (std::holds_alternative<std::monostate>(value)) return py::none();
    if (const auto* handle = std::get_if<script::Handle>(&value))
        return py::cast(handle_text(session.engine.world, *handle));
    if (const auto* vector = std::get_if<Vec3>(&value)) return py::make_tuple((*vector)[0], (*vector)[1], (*vector)[2]);
    if (const auto* compound = std::get_if<std::shared_ptr<const script::Compound>>(&value)) {
        const auto& all = **compound;
        if (all.kind == "map") {
            py::dict map;
            for (std::size_t k = 0; k < all.keys.size(); ++k)
                map[from_script(session, all.keys[k])] = from_script(session, all.members[k]);
            return map;
        }
        py::list list;
        for (const auto& member : all.members) list.append(from_script(session, member));
        return list;
    }
    if (const auto* truth = std::get_if<bool>(&value)) return py::cast(*truth);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return py::cast(*whole);
    if (const auto* number = std::get_if<double>(&value)) return py::cast(*number);
    return py::cast(std::get<std::string>(value));
}

script::Value to_script(const py::handle& value) {
    if (value.is_none()) return std::monostate{};
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    if (py::isinstance<py::int_>(value)) return value.cast<std::int64_t>();
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (PyNumber_Check(value.ptr()) != 0 && !py::isinstance<py::sequence>(value))
        return py::float_(py::reinterpret_borrow<py::object>(value)).cast<double>();
    if (py::isinstance<py::sequence>(value) && py::len(value) == 3) {
        Vec3 vector;
        for (int k = 0; k < 3; ++k) vector[k] = value[py::int_(k)].cast<double>();
        return vector;
    }
    throw py::type_error("FISH takes None, a truth, a number, a text or three numbers");
}

} // namespace kaya::python
