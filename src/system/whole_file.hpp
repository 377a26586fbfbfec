// Files that are written whole or not at all, and read whole. Their names go through the door (system/door.hpp).
#pragma once

#include "system/gate.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace kaya {

/// Writes a file without a name next to the old one, waits until it is on the disk and then replaces the old one: after a full disk or a
/// crash the old file is unchanged. Pipes and devices are written to directly. Throws Diagnostic (Fault::run) with the reason: folder
/// missing, no permission, disk full.
void write_whole_file(const std::string& path, std::string_view content, Use use = Use::write);

/// Throws Diagnostic: no such file, a folder, not readable.
std::string read_whole_file(const std::string& path);

/// For callers with their own message: nothing where the file cannot be read. Throws Diagnostic when the gate refuses.
std::optional<std::string> file_text(const std::filesystem::path& file);

} // namespace kaya
