#include "app/sandbox.hpp"

#include "app/landlock.hpp"
#include "app/permissions.hpp"
#include "laws/zone_model.hpp"
#include "system/door.hpp"

#include <cstdlib>
#include <fmt/format.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// Folders of programs, libraries and system settings, without user data.
constexpr const char* system_folders[] = {"/usr", "/lib", "/lib32", "/lib64", "/bin", "/etc",
                                          "/opt", "/nix", "/gnu",   "/proc",  "/sys", "/dev"};

/// Devices that may be read or written.
constexpr const char* devices[] = {"/dev/null", "/dev/tty", "/dev/full", "/dev/shm"};

/// Endings that the program adds to a name when there is no file of that name.
constexpr const char* endings[] = {"", ".kaya.h5", ".3dd", ".dat", ".3ddat", ".fis", ".txt"};

void add_folders(std::vector<fs::path>& folders, const char* listed) {
    std::string_view rest(listed ? listed : "");
    while (!rest.empty()) {
        const auto end = std::min(rest.find(':'), rest.size());
        if (end > 0) folders.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
}

/// The file that the program will open for a name on the command line.
fs::path found(const std::string& name) {
    std::error_code ignored;
    for (const char* ending : endings)
        if (fs::exists(name + ending, ignored)) return name + ending;
    return name;
}

/// The folder, or the nearest one above in which it will be made.
fs::path present(fs::path folder) {
    std::error_code ignored;
    for (folder = resolved(folder); !folder.empty() && !fs::exists(folder, ignored); folder = folder.parent_path()) {}
    return folder;
}

/// Caches of other programs.
std::vector<fs::path> caches() {
    std::vector<fs::path> folders;
    for (const char* name : {"XDG_CACHE_HOME", "CCACHE_DIR"})
        if (const char* folder = std::getenv(name)) folders.emplace_back(folder);
    if (const char* home = std::getenv("HOME"))
        for (const char* name : {".cache", ".ccache"}) folders.push_back(fs::path(home) / name);
    return folders;
}

void add(std::vector<fs::path>& paths, const auto& more) {
    paths.insert(paths.end(), std::begin(more), std::end(more));
}

KernelLock kernel_lock(const Gate::Policy& policy, const SandboxOrder& order) {
    KernelLock lock{policy.folders, policy.libraries, {}, order.connects, order.listens};
    add(lock.writable, devices);
    for (const auto* own : {&order.outputs, &order.kept})
        for (const auto& path : *own) lock.writable.push_back(present(path));
    add(lock.readable, policy.named);
    std::error_code ignored;
    auto& systems = order.programs == Programs::none ? lock.readable : lock.programs;
    add(systems, system_folders);
    systems.push_back(fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path());
    add_folders(lock.readable, std::getenv("LD_LIBRARY_PATH"));
    lock.readable.push_back(permissions_file());
    for (const auto& [digest, library] : read_permissions().libraries) lock.readable.push_back(library.parent_path());
    if (order.programs == Programs::none) return lock;
    add_folders(lock.programs, std::getenv("PATH"));
    for (const char* folder : {"/tmp", "/dev"}) lock.writable.emplace_back(folder);
    lock.writable.push_back(fs::temp_directory_path(ignored));
    if (order.programs == Programs::installed) return lock;
    lock.programs.emplace_back("/");
    add(lock.writable, caches());
    return lock;
}

} // namespace

Gate::Policy policy_of(const SandboxOrder& order) {
    Gate::Policy policy;
    policy.folders.emplace_back(".");
    std::error_code ignored;
    for (const auto& input : order.inputs) {
        policy.named.push_back(found(input));
        const fs::path folder = fs::is_directory(input, ignored) ? fs::path(input) : fs::path(input).parent_path();
        if (!folder.empty() && folder != "/dev") policy.folders.push_back(folder); // the standard input has no folder
    }
    add(policy.folders, order.outputs);
    const Permissions permissions = read_permissions();
    add(policy.folders, permissions.folders);
    for (const auto& [digest, library] : permissions.libraries) {
        policy.digests.insert(digest);
        policy.named.push_back(library);
    }
    policy.libraries = with_zone_folders(order.joint_folders);
    policy.permissions = permissions_file();
    policy.own = order.kept;
    if (!policy.permissions.empty()) policy.own.push_back(policy.permissions);
    return policy;
}

void shut_in(const SandboxOrder& order) {
    Gate::Policy policy = policy_of(order);
    lock_by_kernel(kernel_lock(policy, order));
    auto gate = std::make_shared<Gate>();
    gate->shut(std::move(policy));
    door::set_gate(std::move(gate));
}

std::string describe_sandbox(const Gate::Policy& policy) {
    std::string text;
    const auto add_line = [&](std::string_view what, const fs::path& path) {
        text += fmt::format("{:<12} {}\n", what, path.string());
    };
    for (const auto& folder : policy.folders) add_line("files", resolved(folder));
    for (const auto& folder : policy.libraries) {
        std::error_code ignored;
        if (fs::is_directory(folder, ignored)) add_line("libraries", folder);
    }
    for (const auto& [digest, library] : read_permissions().libraries) add_line("library", library);
    const int version = landlock_version();
    add_line(
        "kernel",
        version > 0
            ? fmt::format("Landlock {}: native joint models are held to these files too, and start no program", version)
            : std::string("no Landlock: native joint models can do what you can do"));
    if (version >= landlock_with_connections) add_line("connections", std::string("none by TCP, but for --watch"));
    if (version >= landlock_with_signals) add_line("signals", std::string("none to other programs"));
    add_line("--trust", std::string("lifts all of this"));
    return text;
}

} // namespace kaya
