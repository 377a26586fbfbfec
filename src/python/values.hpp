// Values of FISH and Lua in Python.
#pragma once

#include "commands/session/session.hpp"

#include <pybind11/pybind11.h>

namespace kaya::python {

/// None, bool, int, float, str, a list of three numbers for a vector; lists and maps as lists and dicts; objects of the model as
/// "block 12".
pybind11::object from_script(Session& session, const script::Value& value);
/// None, bool, int, float, str, three numbers. Throws TypeError for all else.
script::Value to_script(const pybind11::handle& value);

} // namespace kaya::python
