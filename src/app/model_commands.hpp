// Commands of the program that are about joint and zone models: jmodel build, zmodel build, new-jmodel, new-zmodel, plugin list.
#pragma once

#include <filesystem>
#include <functional>

namespace CLI {
class App;
} // namespace CLI

namespace kaya {

/// Adds them. The requested one is returned through `chosen` as a function that runs it and returns the exit status; it throws Diagnostic.
void add_model_commands(CLI::App& app, const std::filesystem::path& program_folder,
                        const std::function<std::vector<std::filesystem::path>()>& joint_folders,
                        std::function<int()>& chosen);

} // namespace kaya
