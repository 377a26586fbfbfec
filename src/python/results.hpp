// Curves and forces of a model as Python sees them.
#pragma once

#include "python/running.hpp"

namespace kaya::python {

/// [(number, label, times, cycles, values)]
pybind11::list histories(PythonSession& self);

/// A dict for each pair of bodies with contacts, which are searched when there are none yet.
pybind11::list interfaces(PythonSession& self);

/// {groups: {name: {held, force, weight}}, reaction, weight, load, unbalanced}
pybind11::dict reactions(PythonSession& self);

} // namespace kaya::python
