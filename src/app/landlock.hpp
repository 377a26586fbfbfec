// Linux' own lock on files and connections: it holds whatever code runs in the program, native joint models included.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace kaya {

/// Version of Landlock that the kernel offers; 0: none.
int landlock_version();
/// The first version that knows connections.
inline constexpr int landlock_with_connections = 4;

/// The files and ports that stay open. A folder stands for everything below it.
struct KernelLock {
    std::vector<std::filesystem::path> writable; ///< and readable
    std::vector<std::filesystem::path> readable;
    std::vector<std::filesystem::path> programs; ///< readable, and programs there may be started
    bool connects = false;                       ///< TCP as before
    std::optional<int> listens;                  ///< a port on which the program itself listens; 0: any
};

/// Holds this thread and all that it starts from now on. To be called before other threads are there; a second lock can only take
/// more away. False: the kernel cannot.
bool lock_by_kernel(const KernelLock& lock);

} // namespace kaya
