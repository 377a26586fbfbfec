// Functions of Python that the engine keeps, and output to them.
#pragma once

#include <cstdio>
#include <memory>
#include <pybind11/pybind11.h>

namespace kaya::python {

/// A function that threads without the interpreter lock may copy and delete.
std::shared_ptr<const pybind11::function> kept(const pybind11::function& function);

struct CloseUnlocked {
    void operator()(std::FILE* stream) const;
};
using Stream = std::unique_ptr<std::FILE, CloseUnlocked>;

/// What is written to it is given to `write`, line by line.
Stream stream_to(const pybind11::function& write);

} // namespace kaya::python
