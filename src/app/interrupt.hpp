// Ctrl-C: the run stops after its cycle; a second Ctrl-C ends the program at once.
#pragma once

#include "base/stop_point.hpp"
#include "commands/session/session.hpp"

#include <array>
#include <csignal>

namespace kaya {

/// The actions of signals at its construction; its destructor restores them.
class SignalActions {
public:
    SignalActions();
    ~SignalActions();
    SignalActions(const SignalActions&) = delete;
    SignalActions& operator=(const SignalActions&) = delete;

    /// SIGHUP is ignored under nohup.
    bool ignores(int signal) const;

private:
    static constexpr std::array signals_{SIGINT, SIGTERM, SIGHUP};
    std::array<struct sigaction, signals_.size()> actions_{};
};

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
    SignalActions before_;
};

/// While it exists and no InterruptGuard does, no signal ends the program: it interrupts the read from the terminal.
class PromptSignals {
public:
    PromptSignals();
    PromptSignals(const PromptSignals&) = delete;
    PromptSignals& operator=(const PromptSignals&) = delete;

    /// A signal asks the program to end: the terminal was closed, or the system shuts down.
    static bool is_to_end();

private:
    SignalActions before_;
};

} // namespace kaya
