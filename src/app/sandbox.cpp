#include "app/sandbox.hpp"

#include "app/landlock.hpp"
#include "app/permissions.hpp"
#include "laws/zone_model.hpp"

#include <cstdlib>
#include <fmt/format.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// Where systems keep programs, libraries and their settings, and no user's work.
constexpr const char* system_folders[] = {"/usr", "/lib", "/lib32", "/lib64", "/bin", "/etc",
                                          "/opt", "/nix", "/gnu",   "/proc",  "/sys", "/dev"};

/// A reader or writer that is no file.
constexpr const char* devices[] = {"/dev/null", "/dev/tty", "/dev/full", "/dev/shm"};

void add_folders(std::vector<fs::path>& folders, const char* listed) {
    std::string_view rest(listed ? listed : "");
    while (!rest.empty()) {
        const auto end = std::min(rest.find(':'), rest.size());
        if (end > 0) folders.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
}

} // namespace

Gate::Policy policy_of(const SandboxOrder& order) {
    Gate::Policy policy;
    policy.folders.emplace_back(".");
    for (const auto& input : order.inputs) {
        policy.named.emplace_back(input);
        const fs::path folder = fs::path(input).parent_path();
        if (!folder.empty() && folder != "/dev") policy.folders.push_back(folder); // the standard input has no folder
    }
    const Permissions permissions = read_permissions();
    policy.folders.insert(policy.folders.end(), permissions.folders.begin(), permissions.folders.end());
    for (const auto& [digest, library] : permissions.libraries) policy.digests.insert(digest);
    policy.libraries = with_zone_folders(order.joint_folders);
    policy.permissions = permissions_file();
    return policy;
}

bool lock(const Gate::Policy& policy, const SandboxOrder& order) {
    std::vector<fs::path> writable = policy.folders, readable = policy.libraries;
    writable.insert(writable.end(), std::begin(devices), std::end(devices));
    writable.insert(writable.end(), order.kept.begin(), order.kept.end());
    readable.insert(readable.end(), std::begin(system_folders), std::end(system_folders));
    readable.insert(readable.end(), policy.named.begin(), policy.named.end());
    std::error_code ignored;
    readable.push_back(fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path());
    add_folders(readable, std::getenv("LD_LIBRARY_PATH"));
    for (const auto& [digest, library] : read_permissions().libraries) readable.push_back(library.parent_path());
    return lock_file_system(writable, readable);
}

std::string describe_sandbox(const Gate::Policy& policy) {
    std::string text;
    const auto add = [&](std::string_view what, const fs::path& path) {
        text += fmt::format("{:<12} {}\n", what, path.string());
    };
    for (const auto& folder : policy.folders) add("files", resolved(folder));
    for (const auto& folder : policy.libraries) {
        std::error_code ignored;
        if (fs::is_directory(folder, ignored)) add("libraries", folder);
    }
    for (const auto& [digest, library] : read_permissions().libraries) add("library", library);
    const int version = landlock_version();
    add("kernel",
        version > 0
            ? fmt::format("Landlock {}: native joint models are held to these files too, and start no program", version)
            : std::string("no Landlock: native joint models can do what you can do"));
    add("--trust", std::string("lifts all of this"));
    return text;
}

} // namespace kaya
