// Ctrl-C in a process that belongs to another program, such as Python.
#pragma once

#include <memory>

namespace kaya {

/// Signals belong to it.
bool is_main_thread();

/// While it lives, Ctrl-C calls `act` in place of what the process did before.
class InterruptSignal {
public:
    explicit InterruptSignal(void (*act)());
    ~InterruptSignal();
    InterruptSignal(const InterruptSignal&) = delete;
    InterruptSignal& operator=(const InterruptSignal&) = delete;

private:
    struct Before;
    std::unique_ptr<Before> before_;
};

} // namespace kaya
