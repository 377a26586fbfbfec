// Another program, and what it says.
#pragma once

#include <string>
#include <vector>

namespace kaya {

struct CommandOutput {
    int status = 0;     ///< 127: there is no such program
    std::string output; ///< of both streams, or of the first alone
};

/// Looks for the program in PATH and waits for its end. No shell reads the words.
CommandOutput output_of(const std::vector<std::string>& words, bool with_errors = true);

} // namespace kaya
