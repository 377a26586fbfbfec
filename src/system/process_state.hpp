// State of the process that a law can change: the working folder, signal handlers, limits. It is restored and reported.
#pragma once

#include <string>
#include <vector>

namespace kaya {

/// Takes the state of the process, once; to be called before a law is loaded.
void take_process_state();

/// Starts again: a new session may be in another folder.
void forget_process_state();

/// Restores the state that laws have changed since, and returns its parts in words ("the working folder"). Checks nothing if no law was
/// called since the last time. `who` receives the laws that were called. Ends the program when the standard streams cannot be restored.
std::vector<std::string> put_process_state_back(std::string& who);

} // namespace kaya
