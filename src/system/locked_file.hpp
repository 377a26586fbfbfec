// A file whose lock belongs to one run, until the run ends in whatever way.
#pragma once

#include "system/descriptor.hpp"

#include <filesystem>

namespace kaya {

struct LockedFile {
    Descriptor file;   ///< none: no file can be made here
    bool busy = false; ///< another run has it
};

/// Locks a file, which is made where there is none. Does not wait.
LockedFile lock_file(const std::filesystem::path& file);

/// A lock is empty: a file with content is kept.
bool is_empty(const Descriptor& file);

} // namespace kaya
