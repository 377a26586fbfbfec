// The text of a file that a deck names.
#pragma once

#include "base/diagnostic.hpp"
#include "system/whole_file.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <string>

namespace kaya {

/// Throws Diagnostic with the system's reason when the file cannot be opened or read.
inline std::string input_text(const std::string& path) {
    auto text = file_text(path);
    if (!text)
        throw Diagnostic(fmt::format("{} cannot be opened: {}", path, std::strerror(errno)),
                         "check the name and the folder");
    return std::move(*text);
}

} // namespace kaya
