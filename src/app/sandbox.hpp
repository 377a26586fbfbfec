// Puts together what a run may do: of the command line, of the user's permissions, of where the program lies.
#pragma once

#include "base/gate.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace kaya {

struct SandboxOrder {
    std::vector<std::string> inputs;                  ///< decks or the journal, as given on the command line
    std::vector<std::filesystem::path> joint_folders; ///< those that the user or the installation named
    std::vector<std::filesystem::path> kept;          ///< what the program itself writes, not the deck
};

Gate::Policy policy_of(const SandboxOrder& order);

/// The kernel's part. False where it has none.
bool lock(const Gate::Policy& policy, const SandboxOrder& order);

/// `kaya info --sandbox`: what holds for a run in this folder.
std::string describe_sandbox(const Gate::Policy& policy);

} // namespace kaya
