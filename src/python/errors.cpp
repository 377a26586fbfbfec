#include "python/errors.hpp"

#include "base/diagnostic.hpp"
#include "lang/interp/deck.hpp"

#include <exception>
#include <pybind11/stl.h>

namespace kaya::python {

namespace py = pybind11;

namespace {

/// The class of the errors; it lives as long as the interpreter.
PyObject* error_class = nullptr;

py::object as_error(const Diagnostic& problem) {
    py::object error = py::reinterpret_borrow<py::object>(error_class)(render(problem));
    error.attr("message") = problem.message;
    error.attr("hint") = problem.hint;
    error.attr("code") = problem.code;
    error.attr("context") = problem.context;
    error.attr("status") = static_cast<int>(problem.fault);
    const bool placed = static_cast<bool>(problem.place);
    error.attr("file") = placed ? py::cast(problem.place.source->name) : py::none();
    error.attr("line") = placed ? py::cast(problem.place.line) : py::none();
    error.attr("column") = placed ? py::cast(problem.place.column) : py::none();
    return error;
}

void raise(const py::object& error) { PyErr_SetObject(error_class, error.ptr()); }

} // namespace

void add_errors(py::module_& module) {
    error_class = PyErr_NewExceptionWithDoc(
        "kaya.Error",
        "What kaya says when something is wrong.\n\n"
        "str(error) is the whole text with the line and its underline; message, hint, file, line, column, code, context\n"
        "are its parts (file, line, column: None where there is no place), status is the exit status of the program:\n"
        "1 the deck is wrong, 2 the run failed, 3 a fault of kaya. errors: all of them, when several were found.",
        PyExc_RuntimeError, nullptr);
    if (error_class == nullptr) throw py::error_already_set();
    module.add_object("Error", py::reinterpret_borrow<py::object>(error_class));
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const lang::DeckErrors& several) {
            py::list all;
            std::string text;
            for (const auto& one : several.all) {
                all.append(as_error(one));
                text += (text.empty() ? "" : "\n") + render(one);
            }
            const py::object error = as_error(several);
            error.attr("errors") = all;
            error.attr("args") = py::make_tuple(text);
            raise(error);
        } catch (const Diagnostic& problem) {
            const py::object error = as_error(problem);
            error.attr("errors") = py::make_tuple(error);
            raise(error);
        }
    });
}

} // namespace kaya::python
