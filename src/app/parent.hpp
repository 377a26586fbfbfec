// The process that waits for the run and reports how it ended.
#pragma once

#include <functional>

namespace kaya {

/// Does the work in a child process and waits for it; returns the exit status in both processes. An ending that is not the
/// program's own is reported (laws/ending.hpp). Signals to this process are passed on. It stops and continues with the child, both are in one
/// process group, and when this process is killed the child is killed, too. Under a debugger, or if no process can be started, the work
/// is done here. Call it before there are threads.
int run_in_child(const std::function<int()>& work);

} // namespace kaya
