// Reads the text of a deck, from any editor, and refuses binary files.
#pragma once

#include "base/diagnostic.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace kaya::lang {

using Source = std::shared_ptr<const SourceText>;

/// Splits text into lines: LF, CR/LF and CR end a line; a UTF-8 byte order mark at the start and a
/// control-Z at the end (old DOS editors) are dropped. `first_line` > 1 numbers the lines of a piece of
/// another file. Throws Diagnostic when the text holds a NUL byte or starts like a binary file.
Source source_from_text(std::string name, std::string_view text, int first_line = 1);

/// Reads a file; `name` is its name in messages. Throws Diagnostic: missing, a folder, unreadable, larger than any deck, binary.
Source read_source(const std::filesystem::path& path, std::string name);

/// Finds the file of a deck: the name as written, then with .3dd .dat .3ddat .fis .txt, in each folder in turn. Throws Diagnostic with the
/// nearest file name as suggestion.
std::filesystem::path find_deck(const std::string& name, const std::vector<std::filesystem::path>& folders);

} // namespace kaya::lang
