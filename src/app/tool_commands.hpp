// Commands of the program that run no deck: fmt, explain, info, report, export, diff, allow, check and help.
#pragma once

#include "app/run.hpp"

#include <functional>

namespace CLI {
class App;
} // namespace CLI

namespace kaya {

/// Adds them. The requested one is returned through `chosen` as a function that runs it and returns the exit status; it throws Diagnostic.
/// `order` and `program`, the program's folder, define the permissions.
void add_tool_commands(CLI::App& app, const RunOrder& order, const std::filesystem::path& program,
                       std::function<int()>& chosen);

} // namespace kaya
