// The module kaya._kaya; the package around it is stdlib/python/kaya.

#include "commands/list/interfaces.hpp"
#include "commands/program/program.hpp"
#include "commands/list/reactions.hpp"
#include "laws/run_record.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "model/kinds/groups.hpp"
#include "model/measure/joint_polygons.hpp"
#include "model/whole/state_hash.hpp"
#include "python/errors.hpp"
#include "python/fields.hpp"
#include "python/running.hpp"
#include "python/values.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace kaya::python {

namespace py = pybind11;

namespace {

py::array_t<double> array_of(const Vec3& vector) { return py::array_t<double>(3, vector.data()); }
py::array_t<double> array_of(const std::vector<double>& numbers) {
    return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

std::unique_ptr<PythonSession> new_session(const py::function& out, const py::function& messages, int threads,
                                           bool strict, bool quiet, bool trust,
                                           const std::vector<std::filesystem::path>& joints,
                                           const std::vector<std::filesystem::path>& own_joints) {
    Options options;
    options.colour = "never";
    options.threads = threads;
    options.strict = strict;
    options.quiet = quiet;
    options.trust = trust;
    options.in_host = true;
    options.joint_folders = joints;
    options.joint_folders.insert(options.joint_folders.end(), own_joints.begin(), own_joints.end());
    options.own_joints = own_joints;
    add_own_folders(own_joints);
    return std::make_unique<PythonSession>(out, messages, options);
}

py::list histories(PythonSession& self) {
    const auto& histories = self.session().model.histories;
    py::list all;
    for (const auto& history : histories.all) {
        const auto first = static_cast<std::ptrdiff_t>(history.first_sample);
        const std::vector<double> time(histories.time.begin() + first, histories.time.end());
        const std::vector<double> cycles(histories.cycle.begin() + first, histories.cycle.end());
        all.append(
            py::make_tuple(history.number, history.label, array_of(time), array_of(cycles), array_of(history.values)));
    }
    return all;
}

py::list interfaces(PythonSession& self) {
    Session& session = self.session();
    Model& model = session.model;
    if (!session.inside_cycle) find_contacts(model, session.joints);
    std::vector<Row> all(model.contacts.size());
    for (std::size_t row = 0; row < all.size(); ++row) all[row] = static_cast<Row>(row);
    py::list result;
    for (const auto& one : interfaces_of(model, all)) {
        py::list polygons;
        for (const Row contact : one.contacts)
            for (const auto& polygon : joint_polygons(model, contact)) {
                py::array_t<double> corners({static_cast<py::ssize_t>(polygon.size()), py::ssize_t{3}});
                double* to = corners.mutable_data();
                for (const auto& corner : polygon)
                    for (const double part : corner) *to++ = part;
                polygons.append(corners);
            }
        py::dict row;
        row["block1"] = model.blocks.number[one.first];
        row["block2"] = model.blocks.number[one.second];
        row["contacts"] = one.contacts;
        row["area"] = one.area;
        row["normal"] = array_of(one.normal);
        row["force"] = array_of(one.force);
        row["moment"] = array_of(one.moment);
        row["centre"] = array_of(one.centre);
        row["point"] = array_of(one.point_of_action());
        row["normal_force"] = one.normal_force();
        row["shear_force"] = one.shear_force();
        row["polygons"] = polygons;
        result.append(row);
    }
    return result;
}

py::dict reactions(PythonSession& self) {
    const Model& model = self.session().model;
    const auto found = reactions_of(model, [](Row) { return true; });
    py::dict groups;
    for (const auto& one : found.groups) {
        py::dict row;
        row["held"] = one.held;
        row["force"] = array_of(one.force);
        row["weight"] = array_of(one.weight);
        groups[py::str(std::string(default_group(model, one.group)))] = row;
    }
    py::dict result;
    result["groups"] = groups;
    result["reaction"] = array_of(found.reaction);
    result["weight"] = array_of(found.weight);
    result["load"] = array_of(found.load);
    result["unbalanced"] = array_of(found.unbalanced);
    return result;
}

} // namespace

PYBIND11_MODULE(_kaya, module) {
    module.doc() = "The engine of kaya. Use the package kaya.";
    module.attr("__version__") = program_version();
    add_errors(module);
    module.def("kinds", &kind_names);
    py::class_<PythonSession>(module, "Session")
        .def(py::init(&new_session), py::arg("out"), py::arg("messages"), py::arg("threads"), py::arg("strict"),
             py::arg("quiet"), py::arg("trust"), py::arg("joints"), py::arg("own_joints"))
        .def("text", &PythonSession::text, py::arg("commands"), py::arg("name"), py::arg("caught"))
        .def("deck", &PythonSession::deck, py::arg("file"))
        .def("fields", [](PythonSession&, const std::string& kind) { return field_names(kind); })
        .def("count", [](PythonSession& self, const std::string& kind) { return count_objects(self.session(), kind); })
        .def("values", [](PythonSession& self, const std::string& kind,
                          const std::string& field) { return field_values(self.session(), kind, field); })
        .def("set_values", [](PythonSession& self, const std::string& kind, const std::string& field,
                              const py::array_t<std::int64_t>& rows,
                              const py::object& values) { set_field(self.session(), kind, field, rows, values); })
        .def("quantity",
             [](PythonSession& self, const std::string& name) { return global_value(self.session(), name); })
        .def("columns", [](PythonSession& self) { return column_names(self.session().model); })
        .def("column",
             [](PythonSession& self, const std::string& table, const std::string& column) {
                 return column_array(self.session().model, table, column, self.borrowed());
             })
        .def("histories", &histories)
        .def("interfaces", &interfaces)
        .def("reactions", &reactions)
        .def("value",
             [](PythonSession& self, const std::string& expression) {
                 script::Value value;
                 self.run([&](Session& session) { value = session.scripts->value(expression); });
                 return from_script(self.session(), value);
             })
        .def("set_value",
             [](PythonSession& self, const std::string& name, const py::object& value) {
                 const script::Value given = to_script(value);
                 self.run([&](Session& session) { session.scripts->set(name, given); });
             })
        .def("call_in_cycles", &PythonSession::call_in_cycles, py::arg("function"), py::arg("moment"),
             py::arg("interval"))
        .def("leave_out", &PythonSession::leave_out, py::arg("number"))
        .def("interrupt", &PythonSession::interrupt)
        .def("hash", [](PythonSession& self) { return state_hash(self.session().model); })
        .def("warnings", [](PythonSession& self) { return self.session().warning_texts; });
}

} // namespace kaya::python
