// Prints the struct of a command as a line.
#pragma once

#include "lang/interp/spec.hpp"

#include <any>
#include <optional>
#include <string>

namespace kaya::lang {

/// A line of the dialect that fills the same struct, to the last bit; nothing when no command of the dialect does so.
std::optional<std::string> line_of(const std::any& command, const Language& dialect);

} // namespace kaya::lang
