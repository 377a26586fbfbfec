// Permissions beyond the folders of a run: `kaya allow`, stored in the user's configuration.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace kaya {

struct Permissions {
    std::vector<std::filesystem::path> folders; ///< files below may be read and written
    std::map<std::string, std::filesystem::path>
        libraries; ///< joint models by sha256, with the place where they were seen
};

/// kaya/allowed below XDG_CONFIG_HOME, or .config of the home folder; empty when there is neither.
std::filesystem::path permissions_file();

/// Empty when there is no such file. Throws Diagnostic when it is not a list of permissions.
Permissions read_permissions();

/// Allows a folder, or a library in its present state. Throws Diagnostic when it is neither.
void allow(const std::filesystem::path& path);

/// Revokes a permission. Throws Diagnostic when there was none.
void revoke(const std::filesystem::path& path);

/// One line for each.
std::string describe(const Permissions& permissions);

} // namespace kaya
