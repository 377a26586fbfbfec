// Files that are written whole or not at all, and read whole.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// Writes next to the file, makes sure that it is on the disk and then takes its place: a full disk or a
/// crash leaves what was there before. Pipes and devices are written to directly. Throws Diagnostic
/// (Fault::run) that says why: folder missing, no permission, disk full.
void write_whole_file(const std::string& path, std::string_view content);

/// Throws Diagnostic: no such file, a folder, not readable.
std::string read_whole_file(const std::string& path);

} // namespace kaya
