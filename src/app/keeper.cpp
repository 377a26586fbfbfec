#include "app/keeper.hpp"

#include "commands/session/autosave.hpp"
#include "system/crash_report.hpp"

#include <csignal>
#include <ctime>
#include <pthread.h>

namespace kaya {

namespace {

std::atomic<Keeper*> keeping = nullptr;

} // namespace

/// In a signal handler: waits for the thread, until a limit if that hangs or crashes too.
void Keeper::act() {
    Keeper* const keeper = keeping.exchange(nullptr);
    if (keeper == nullptr) return;
    ::sem_post(&keeper->wanted_);
    constexpr timespec tick{0, 20'000'000};
    constexpr int most_ticks = 1500; // half a minute: a large model takes its time
    for (int i = 0; i < most_ticks && !keeper->written_; ++i) ::nanosleep(&tick, nullptr);
}

Keeper::Keeper(Session& session) : session_(session) {
    ::sem_init(&wanted_, 0, 0);
    sigset_t all, before; // signals are for the thread that runs the commands
    ::sigfillset(&all);
    for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::sigdelset(&all, crash);
    ::pthread_sigmask(SIG_BLOCK, &all, &before);
    thread_ = std::thread([this] { write(); });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    keeping = this;
    set_last_act(act);
}

Keeper::~Keeper() {
    keeping = nullptr;
    set_last_act(nullptr);
    ends_ = true;
    ::sem_post(&wanted_);
    thread_.join();
    ::sem_destroy(&wanted_);
}

void Keeper::write() {
    while (::sem_wait(&wanted_) != 0) {}
    if (ends_) return;
    session_.autosave->keep_copy();
    written_ = true;
}

} // namespace kaya
