// `kaya study`: many runs of one deck.
#pragma once

#include "app/run.hpp"

#include <functional>

namespace CLI {
class App;
} // namespace CLI

namespace kaya {

/// `action` is set when the command line asks for a study; it gives the exit status.
void add_study_commands(CLI::App& app, const RunOrder& order, const std::filesystem::path& program,
                        std::function<int()>& action);

} // namespace kaya
