// kaya jtest, kaya jfit and kaya ztest: one sub-contact of a joint model, or one zone of a zone model, without a deck.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace kaya {

/// Adds both to the command line. When one of them is used, `chosen` becomes its action, which returns the exit status and throws
/// Diagnostic.
void add_joint_bench(CLI::App& app, const std::function<std::vector<std::filesystem::path>()>& joint_folders,
                     std::function<int()>& chosen);

/// The same for ztest; the folders are those of joint models.
void add_zone_bench(CLI::App& app, const std::function<std::vector<std::filesystem::path>()>& folders,
                    std::function<int()>& chosen);

} // namespace kaya
