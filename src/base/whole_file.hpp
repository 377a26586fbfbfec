// Files that are written whole or not at all, and read whole. Their names go through the door (base/door.hpp).
#pragma once

#include "base/gate.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace kaya {

/// Writes a file without a name next to the old one, makes sure that it is on the disk and then takes the place of the old one: a
/// full disk or a crash leaves what was there before. Pipes and devices are written to directly. Throws Diagnostic
/// (Fault::run) that says why: folder missing, no permission, disk full.
void write_whole_file(const std::string& path, std::string_view content, Use use = Use::write);

/// Throws Diagnostic: no such file, a folder, not readable.
std::string read_whole_file(const std::string& path);

/// For callers with a message of their own: nothing where the file cannot be read. Throws Diagnostic when the gate refuses.
std::optional<std::string> file_text(const std::filesystem::path& file);

} // namespace kaya
