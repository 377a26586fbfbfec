// Limits of the system on this process: stack and open files.
#pragma once

namespace kaya {

/// Raises limits that are too low, as far as the user may. Throws Diagnostic (Fault::run) with the shell's command if that is not enough: a stack
/// overflow is a crash, and a file that cannot be opened looks like a missing one.
void require_stack_and_files();

} // namespace kaya
