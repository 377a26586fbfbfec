// kaya jtest and kaya jfit: one sub-contact of a joint model, without a deck.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <vector>

namespace kaya {

/// Adds both to the command line. When one of them is on it, `chosen` becomes what is to be done; it returns the exit
/// status and throws Diagnostic.
void add_joint_bench(CLI::App& app, const std::function<std::vector<std::filesystem::path>()>& joint_folders,
                     std::function<int()>& chosen);

} // namespace kaya
