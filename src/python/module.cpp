// The module kaya._kaya; the package around it is stdlib/python/kaya.

#include "commands/program/program.hpp"
#include "guide/completion.hpp"
#include "guide/help_text.hpp"
#include "lang/interp/deck.hpp"
#include "lang/modern/language.hpp"
#include "model/whole/state_hash.hpp"
#include "pictures/painter.hpp"
#include "python/errors.hpp"
#include "python/fields.hpp"
#include "python/results.hpp"
#include "python/running.hpp"
#include "python/values.hpp"
#include "system/run_record.hpp"

#include <array>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace kaya::python {

namespace py = pybind11;

namespace {

using Folders = std::vector<std::filesystem::path>;

std::unique_ptr<PythonSession> new_session(const py::function& out, const py::function& messages, int threads,
                                           bool strict, bool quiet, bool trust, bool progress, const Folders& joints,
                                           const Folders& own_joints, const std::filesystem::path& painter) {
    Options options;
    options.colour = "never";
    options.threads = threads;
    options.strict = strict;
    options.quiet = quiet;
    options.progress = progress;
    options.trust = trust;
    options.joint_folders = joints;
    options.joint_folders.insert(options.joint_folders.end(), own_joints.begin(), own_joints.end());
    options.own_joints = own_joints;
    add_own_folders(own_joints);
    auto session = std::make_unique<PythonSession>(out, messages, options);
    if (!painter.empty()) session->session().painter = std::make_shared<Painter>(painter);
    return session;
}

/// Letters at the end of the line that the words begin with, and the words.
py::tuple completions(PythonSession& self, const std::string& before, const std::string& line) {
    const Proposals found = proposals(self.session(), before, line);
    return py::make_tuple(found.typed, found.words);
}

/// Objects that stay the same while others are made and deleted.
void add_objects(py::module_& module, py::class_<PythonSession>& bound) {
    using Self = PythonSession;
    py::class_<script::Handle>(module, "Handle");
    bound
        .def(
            "handle",
            [](Self& self, const std::string& kind, std::size_t row) { return handle_of(self.session(), kind, row); },
            py::arg("kind"), py::arg("row"))
        .def(
            "row",
            [](Self& self, const script::Handle& object) { return self.session().engine.world.living_row(object); },
            py::arg("object"))
        .def(
            "nearest",
            [](Self& self, const std::string& kind, const std::array<double, 3>& place) {
                std::optional<script::Handle> found;
                self.run([&](Session& session) {
                    found = nearest_object(session, kind, Vec3(place[0], place[1], place[2]));
                });
                return found;
            },
            py::arg("kind"), py::arg("place"));
}

void add_language(py::module_& module) {
    module.def(
        "help", [](const std::string& words) { return help_text(words); }, py::arg("words"));
    module.def(
        "needs_more", [](const std::string& text) { return lang::needs_more(lang::language(), text); },
        py::arg("text"));
    module.def("kinds", &kind_names);
    module.def("fields", &field_names, py::arg("kind"));
}

} // namespace

PYBIND11_MODULE(_kaya, module) {
    module.doc() = "The engine of kaya. Use the package kaya.";
    module.attr("__version__") = program_version();
    add_errors(module);
    add_language(module);
    using Self = PythonSession;
    py::class_<Self> bound(module, "Session");
    add_objects(module, bound);
    bound
        .def(py::init(&new_session), py::arg("out"), py::arg("messages"), py::arg("threads"), py::arg("strict"),
             py::arg("quiet"), py::arg("trust"), py::arg("progress"), py::arg("joints"), py::arg("own_joints"),
             py::arg("painter"))
        .def("text", &Self::text, py::arg("commands"), py::arg("name"), py::arg("caught"))
        .def("deck", &Self::deck, py::arg("file"), py::arg("parameters"))
        .def("completions", &completions, py::arg("before"), py::arg("line"))
        .def(
            "count", [](Self& self, const std::string& kind) { return count_objects(self.session(), kind); },
            py::arg("kind"))
        .def(
            "values",
            [](Self& self, const std::string& kind, const std::string& field) {
                return field_values(self.session(), kind, field);
            },
            py::arg("kind"), py::arg("field"))
        .def(
            "set_values",
            [](Self& self, const std::string& kind, const std::string& field, const py::array_t<std::int64_t>& rows,
               const py::object& values) { set_field(self.session(), kind, field, rows, values); },
            py::arg("kind"), py::arg("field"), py::arg("rows"), py::arg("values"))
        .def(
            "quantity", [](Self& self, const std::string& name) { return global_value(self.session(), name); },
            py::arg("name"))
        .def("columns", [](Self& self) { return column_names(self.session().engine.model); })
        .def(
            "column",
            [](Self& self, const std::string& table, const std::string& column) {
                return column_array(self.session().engine.model, table, column, self.borrowed());
            },
            py::arg("table"), py::arg("column"))
        .def("histories", &histories)
        .def("interfaces", &interfaces)
        .def("reactions", &reactions)
        .def(
            "value",
            [](Self& self, const std::string& expression) {
                script::Value value;
                self.run([&](Session& session) { value = session.engine.scripts->value(expression); });
                return from_script(self.session(), value);
            },
            py::arg("expression"))
        .def(
            "set_value",
            [](Self& self, const std::string& name, const py::object& value) {
                const script::Value given = to_script(value);
                self.run([&](Session& session) { session.engine.scripts->set(name, given); });
            },
            py::arg("name"), py::arg("value"))
        .def("call_in_cycles", &Self::call_in_cycles, py::arg("function"), py::arg("moment"), py::arg("interval"))
        .def("leave_out", &Self::leave_out, py::arg("number"))
        .def("interrupt", &Self::interrupt)
        .def("hash", [](Self& self) { return state_hash(self.session().engine.model); })
        .def("warnings", [](Self& self) { return self.session().program.warning_texts; })
        .def("written", [](Self& self) { return self.session().program.files_written; });
}

} // namespace kaya::python
