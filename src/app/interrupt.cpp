#include "app/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace kaya {

namespace {

std::atomic<Session*> listening = nullptr;

/// Only what a signal handler may do: lock-free atomics, and giving the signal its old meaning back.
void stop(int signal) {
    if (Session* session = listening.load(); session != nullptr) session->interrupt();
    std::signal(signal, SIG_DFL);
}

} // namespace

InterruptGuard::InterruptGuard(Session& session) {
    listening = &session;
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
    // A terminal that is closed stops the run, unless it was started with nohup.
    if (std::signal(SIGHUP, stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    listening = nullptr;
}

} // namespace kaya
