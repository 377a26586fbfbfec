// A look at the file of a shared library before the system loads it.
#pragma once

#include <filesystem>
#include <string>

namespace kaya {

/// Why the file cannot be a shared library for this machine, or empty. The system's loader does not
/// look at the length of a file: it dies of one that was cut off, as by a full disk.
std::string fault_of_library_file(const std::filesystem::path& file);

} // namespace kaya
