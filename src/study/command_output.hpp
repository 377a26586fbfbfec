// Runs another program and collects its output.
#pragma once

#include <string>
#include <vector>

namespace kaya {

struct CommandOutput {
    int status = 0;     ///< 127: the program was not found
    std::string output; ///< of both streams, or of the first alone
};

/// Searches PATH for the program and waits for its end. No shell reads the words.
CommandOutput output_of(const std::vector<std::string>& words, bool with_errors = true);

} // namespace kaya
