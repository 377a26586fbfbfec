// Output of a session to a function of Python.
#pragma once

#include <cstdio>
#include <memory>
#include <pybind11/pybind11.h>

namespace kaya::python {

struct CloseStream {
    void operator()(std::FILE* stream) const;
};
using Stream = std::unique_ptr<std::FILE, CloseStream>;

/// What is written to it is given to `write`, line by line.
Stream stream_to(const pybind11::function& write);

} // namespace kaya::python
