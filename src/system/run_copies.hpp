// Second processes of the run: after fork() in a law both processes would continue the run.
#pragma once

#include "system/run_record.hpp"

namespace kaya {

/// Notes that this process is not a copy: it is the run, or was forked by the program itself.
void begin_original();

/// Whether this process was forked since, by whatever call.
bool is_copy();

/// In a copy: the run knows of it.
void set_noted();

/// Notes who made it and where, for the run to report, and ends this process without a message. To be called in a copy.
[[noreturn]] void end_copy(const Called* who, const char* what);

/// Notes who has called fork() in this process.
void note_copy(const Called* who, const char* what);

/// Throws Diagnostic (Fault::run) when a law has made a copy of the run.
void refuse_copies();

/// Ends the process at once, without exit handlers.
[[noreturn]] void leave(int status);

} // namespace kaya
