// Separate files for two runs of one deck in one folder.
#pragma once

#include "system/descriptor.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace kaya {

/// Names for the journal and the autosave. Each is held by a lock on a file .NAME.kaya-lock in the current folder, which is removed with
/// the run; after a killed run the lock is free and the file is reused.
class RunNames {
public:
    RunNames() = default;
    RunNames(const RunNames&) = delete;
    RunNames& operator=(const RunNames&) = delete;
    ~RunNames();

    struct Taken {
        std::string name;
        bool is_new;   ///< it was not held before
        bool by_other; ///< the plain name belongs to a run in progress
    };
    /// `stem`, or stem-2, stem-3, ... where another run has it. Where no lock can be made the plain name.
    Taken take(const std::string& stem);

private:
    struct Held {
        std::string name;
        Descriptor lock;
        std::filesystem::path file;
    };
    std::map<std::string, Held> held_; ///< by stem
};

/// The part of a deck's name that names of files begin with: without folder and ending, without line ends, and short enough for
/// any file system.
std::string stem_of_deck(const std::string& deck);

} // namespace kaya
