// One case: files in an empty folder, the program run on them in a separate process, and the verdict.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace kaya::soak {

struct File {
    std::string name, bytes;
};

struct Case {
    std::vector<File> files;
    std::vector<std::string> words; ///< of the command line, without the name of the program
};

/// Runs a command line in this process; returns the exit status.
using Work = std::function<int(std::vector<std::string> words)>;

struct Limits {
    double asked_after = 2; ///< processor seconds until it is interrupted, as by Ctrl-C
    double seconds = 20;    ///< until it counts as a hang
    std::size_t megabytes = 4096;
    bool waits = false; ///< the process that is started waits for one that does the work
};

struct Verdict {
    std::string finding; ///< empty: none
    int status = 0;
    bool was_asked = false; ///< was interrupted
    double seconds = 0;     ///< wall time
};

/// Runs `work` in a process with the working folder `folder`, which is emptied first; its output goes to the file `said`.
Verdict trial(const Case& one, const std::filesystem::path& folder, const std::filesystem::path& said,
              const Limits& limits, const Work& work);

} // namespace kaya::soak
