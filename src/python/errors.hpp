// Messages of kaya as exceptions of Python.
#pragma once

#include <pybind11/pybind11.h>

namespace kaya::python {

/// Adds the class kaya.Error to the module, with which every Diagnostic arrives: message, hint, file, line, column, code, context, status.
void add_errors(pybind11::module_& module);

} // namespace kaya::python
