// Linux' own lock on the file system: it holds whatever code runs in the program, native joint models included.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace kaya {

/// Version of Landlock that the kernel offers; 0: none.
int landlock_version();

/// From here on this thread, and all that it starts, opens files for writing in `writable` alone, reads user's files there
/// and in `readable`, and starts no program. To be called before other threads are there. False: the kernel cannot.
bool lock_file_system(const std::vector<std::filesystem::path>& writable,
                      const std::vector<std::filesystem::path>& readable);

} // namespace kaya
