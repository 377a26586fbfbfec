#include "app/interrupt.hpp"

#include "laws/crash_report.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sys/time.h>
#include <unistd.h>

namespace kaya {

namespace {

std::atomic<Session*> listening = nullptr;
std::atomic<bool> asked = false;

/// Time that a script has to hear of it.
constexpr itimerval patience{{0, 0}, {0, 700'000}}, none{};

/// A pattern of Lua can take years to fail, and only this ends it: results so far are flushed and the program exits. Cycles have been
/// autosaved.
void end_if_deaf(int) {
    const Session* session = listening.load();
    tell_whom_it_waits_for();
    if (session == nullptr || !session->is_deaf()) return;
    constexpr char message[] =
        "error: stopped by the user inside of one call into Lua's library that did not come to its end\n";
    if (::ftrylockfile(stdout) == 0) ::fflush_unlocked(stdout);
    [[maybe_unused]] const auto written =
        ::write(STDERR_FILENO, message, sizeof message - 1); // a failure cannot be reported
    std::_Exit(static_cast<int>(Fault::run));
}

/// Signal-safe only: lock-free atomics, and letting a second signal end the program.
void stop(int signal) {
    asked = true;
    if (Session* session = listening.load(); session != nullptr) session->interrupt();
    ::setitimer(ITIMER_REAL, &patience, nullptr);
    std::signal(signal, end_at_once);
}

} // namespace

InterruptGuard::InterruptGuard(Session& session)
    : listener_([&session] {
          if (session.is_to_stop()) session.stop_if_interrupted();
      }) {
    listening = &session;
    std::signal(SIGALRM, end_if_deaf);
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
    // A terminal that is closed stops the run, unless it was started with nohup.
    if (std::signal(SIGHUP, stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

bool InterruptGuard::was_asked() { return asked; }

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, end_at_once);
    std::signal(SIGTERM, SIG_DFL);
    listening = nullptr;
}

} // namespace kaya
