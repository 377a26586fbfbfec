#include "app/interrupt.hpp"

#include "system/crash_report.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <sys/time.h>
#include <unistd.h>

namespace kaya {

namespace {

std::atomic<Session*> listening = nullptr;
std::atomic<bool> asked = false, to_end = false;

/// Time that a script has to hear of it.
constexpr itimerval patience{{0, 0}, {0, 700'000}}, none{};

/// A pattern of Lua can take years to fail, and only this ends it: results so far are flushed and the program exits. Cycles have been
/// autosaved.
void end_if_deaf(int) {
    const Session* session = listening.load();
    tell_whom_it_waits_for();
    if (session == nullptr || !session->is_deaf()) return;
    last_act();
    constexpr char message[] =
        "error: stopped by the user inside of one call into Lua's library that did not come to its end\n";
    if (::ftrylockfile(stdout) == 0) ::fflush_unlocked(stdout);
    [[maybe_unused]] const auto written =
        ::write(STDERR_FILENO, message, sizeof message - 1); // a failure cannot be reported
    std::_Exit(static_cast<int>(Fault::run));
}

double now() {
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::atomic<double> asked_at = 0;

/// A signal to the whole process group arrives twice: the second one comes from the process that waits for this one.
constexpr double echo = 0.2; ///< seconds

void stop_again(int signal) {
    if (now() - asked_at > echo) end_at_once(signal);
}

/// Signal-safe only: lock-free atomics, and letting a second signal end the program.
void stop(int signal) {
    asked = true;
    asked_at = now();
    if (signal != SIGINT) to_end = true;
    if (Session* session = listening.load(); session != nullptr) session->interrupt();
    ::setitimer(ITIMER_REAL, &patience, nullptr);
    std::signal(signal, stop_again);
}

} // namespace

SignalActions::SignalActions() {
    for (std::size_t i = 0; i < signals_.size(); ++i) ::sigaction(signals_[i], nullptr, &actions_[i]);
}

SignalActions::~SignalActions() {
    for (std::size_t i = 0; i < signals_.size(); ++i) {
        ::sigaction(signals_[i], &actions_[i], nullptr);
        const auto handler = actions_[i].sa_handler;
        const bool ends = handler == SIG_DFL || handler == end_at_once;
        if (asked && ends) std::signal(signals_[i], stop_again); // the second copy of the signal may still arrive
    }
}

bool SignalActions::ignores(int signal) const {
    const auto at = std::ranges::find(signals_, signal) - signals_.begin();
    return actions_[static_cast<std::size_t>(at)].sa_handler == SIG_IGN;
}

InterruptGuard::InterruptGuard(Session& session)
    : listener_([&session] {
          if (session.is_to_stop()) session.stop_if_interrupted();
      }) {
    listening = &session;
    std::signal(SIGALRM, end_if_deaf);
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
    if (!before_.ignores(SIGHUP)) std::signal(SIGHUP, stop);
}

bool InterruptGuard::was_asked() { return asked; }

InterruptGuard::~InterruptGuard() { listening = nullptr; }

PromptSignals::PromptSignals() {
    struct sigaction action {}; // without SA_RESTART: what reads returns
    action.sa_handler = [](int signal) {
        if (signal != SIGINT) to_end = true;
    };
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (!before_.ignores(signal)) ::sigaction(signal, &action, nullptr);
}

bool PromptSignals::is_to_end() { return to_end; }

} // namespace kaya
