// Commands of the program that run no deck: fmt, explain, info, report, export, diff, allow, check and help.
#pragma once

#include "app/run.hpp"

#include <CLI/CLI.hpp>
#include <functional>

namespace kaya {

/// Adds them. The one that was asked for is returned through `chosen` as a function that does it and gives the exit status; it throws
/// Diagnostic. `order` and `program`, the program's folder, say what a run here may do.
void add_tool_commands(CLI::App& app, const RunOrder& order, const std::filesystem::path& program,
                       std::function<int()>& chosen);

} // namespace kaya
