// Checks the file of a shared library before the system loads it.
#pragma once

#include <filesystem>
#include <string>

namespace kaya {

/// Why the file cannot be a shared library for this machine, or empty. The system's loader does not check the length of a file: it crashes
/// on one that was cut off, as by a full disk.
std::string fault_of_library_file(const std::filesystem::path& file);

/// Loads the library and calls its function `entry` in a separate process. Returns how that process ended when it failed: "crashes when it
/// is loaded (signal 11)". Empty on success, and also when the library cannot be loaded at all, or lacks the function: loading it into the
/// program reports this safely, with the reason.
std::string fault_of_loading(const std::filesystem::path& file, const char* entry);

} // namespace kaya
