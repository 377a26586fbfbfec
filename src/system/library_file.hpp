// Checks the file of a shared library before the system loads it.
#pragma once

#include <filesystem>
#include <string>

namespace kaya {

struct Called;

/// Whether there is such a file. A name that is too long for a file is that of none.
bool is_there(const std::filesystem::path& file);

/// Why the file cannot be a shared library for this machine, or empty. The system's loader does not check the length of a file: it crashes
/// on one that was cut off, as by a full disk. Throws Diagnostic when the gate refuses.
std::string fault_of_library_file(const std::filesystem::path& file);

/// Loads the library of a law by that name, an absolute path, and calls its function `entry` in a separate process. Says what became of that
/// process when it did not come back well: "crashes when it is loaded (signal 11)". Empty when all is well, also when the library
/// cannot be loaded at all, or lacks the function: that is found again, with its reason, where it does no harm.
std::string fault_of_loading(const std::filesystem::path& name, const char* entry, const Called* who);

} // namespace kaya
