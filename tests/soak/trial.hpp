// One case: files in an empty folder, the program on them in a process of its own, and what came of it.
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

/// The words of a command line done in this process; gives the exit status.
using Work = std::function<int(std::vector<std::string> words)>;

struct Limits {
    double asked_after = 2; ///< seconds of a processor until it is asked to stop, as Ctrl-C does
    double seconds = 20;    ///< until it counts as a hang
    std::size_t megabytes = 4096;
};

struct Verdict {
    std::string finding; ///< empty: none
    int status = 0;
    bool was_asked = false; ///< to stop
    double seconds = 0;     ///< by the clock
};

/// Does `work` in a process whose working folder is `folder`, which is emptied first; what it says goes to the file `said`.
Verdict trial(const Case& one, const std::filesystem::path& folder, const std::filesystem::path& said,
              const Limits& limits, const Work& work);

} // namespace kaya::soak
