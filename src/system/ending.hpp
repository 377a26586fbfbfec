// How a run ended, for the process that waited for it.
#pragma once

namespace kaya {

/// The end of a run, from waitpid().
struct Ending {
    int status = 0; ///< of its exit; unused if a signal ended it
    int signal = 0; ///< 0: none
};

/// Prints on the standard error that SIGSTOP stopped the run while a law is at work: the law may have sent it.
void tell_stop(int signal);

/// Reports on the standard error how the run of run_record() ended, unless the program ended by itself or has reported it: the status or
/// signal, the last command with its place, the running models. Returns how this process is to end: never with status 0 if the run was
/// cut off.
Ending tell_ending(int wait_status);

} // namespace kaya
