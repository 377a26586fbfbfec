// Ctrl-C: the run stops after its cycle; a second Ctrl-C ends the program at once.
#pragma once

#include "base/stop_point.hpp"
#include "commands/session.hpp"

namespace kaya {

/// While it exists, an interrupt from the keyboard (or a request to end) goes to the session.
class InterruptGuard {
public:
    explicit InterruptGuard(Session& session);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// Whether a signal has asked this process to stop.
    static bool was_asked();

private:
    StopListener listener_;
};

} // namespace kaya
