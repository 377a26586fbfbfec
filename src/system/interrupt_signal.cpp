#include "system/interrupt_signal.hpp"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace kaya {

namespace {

std::atomic<void (*)()> act_now = nullptr;

} // namespace

struct InterruptSignal::Before {
    struct sigaction action {};
    void (*act)();
};

bool is_main_thread() { return ::getpid() == ::gettid(); }

InterruptSignal::InterruptSignal(void (*act)()) : before_(std::make_unique<Before>()) {
    before_->act = act_now.exchange(act);
    struct sigaction action {};
    action.sa_handler = [](int) {
        if (const auto listener = act_now.load()) listener();
    };
    ::sigaction(SIGINT, &action, &before_->action);
}

InterruptSignal::~InterruptSignal() {
    ::sigaction(SIGINT, &before_->action, nullptr);
    act_now = before_->act;
}

} // namespace kaya
