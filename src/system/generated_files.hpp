// Files in the tree that a program writes from tables, and a test that they agree with the tables.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace kaya {

/// Writes each file whose text has changed; with `check` it prints the name and `hint` instead. Returns the exit status: 0, or 1 where a
/// file differs, or 2 where one cannot be written.
int write_generated(const std::map<std::filesystem::path, std::string>& files, bool check, const std::string& hint);

/// The whole text of a file; empty when there is none.
std::string text_of_file(const std::filesystem::path& file);

} // namespace kaya
