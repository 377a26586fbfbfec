// Collects what the program may use: from the command line, the user's permissions, and the place of the program.
#pragma once

#include "system/gate.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// Which programs may be started.
enum class Programs {
    none,
    installed, ///< files of the system, of PATH and next to kaya; they may write temporary files
    compiler   ///< the same, and all files that the user may read; they may write their caches
};

struct SandboxOrder {
    std::vector<std::string> inputs;                  ///< files that the user named, as on the command line
    std::vector<std::filesystem::path> joint_folders; ///< those that the user or the installation named
    std::vector<std::filesystem::path> outputs;       ///< folders that the user named; they need not be there
    std::vector<std::filesystem::path> kept;          ///< written by the program itself, not by the deck
    Programs programs = Programs::none;
    bool connects = false;      ///< by TCP: the commands of a queue
    std::optional<int> listens; ///< the port of --watch
};

Gate::Policy policy_of(const SandboxOrder& order);

/// Shuts the gate of the process and the kernel's lock. The gate holds where the kernel has no lock.
void shut_in(const SandboxOrder& order);

/// `kaya info --sandbox`: the permissions of a run in this folder.
std::string describe_sandbox(const Gate::Policy& policy);

} // namespace kaya
