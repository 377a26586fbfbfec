// The lock of Linux on files and connections: it applies to all code in the program, native joint models included.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace kaya {

/// Version of Landlock that the kernel offers; 0: none.
int landlock_version();
/// The first version that restricts connections.
inline constexpr int landlock_with_connections = 4;
/// The first version that keeps signals among the locked processes.
inline constexpr int landlock_with_signals = 6;

/// The allowed files and ports. A folder includes everything below it.
struct KernelLock {
    std::vector<std::filesystem::path> writable; ///< and readable
    std::vector<std::filesystem::path> readable;
    std::vector<std::filesystem::path> programs; ///< readable, and programs there may be started
    bool connects = false;                       ///< TCP as before
    std::optional<int> listens;                  ///< a port on which the program itself listens; 0: any
};

/// Restricts this thread and all threads and processes that it starts. Must be called before other threads exist; a second lock can only
/// restrict further. False: the kernel does not support it.
bool lock_by_kernel(const KernelLock& lock);

} // namespace kaya
