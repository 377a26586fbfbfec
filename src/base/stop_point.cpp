#include "base/stop_point.hpp"

#include <utility>

namespace kaya {

namespace {

thread_local const StopListener* listener = nullptr; // several sessions may work at once, each in its thread

} // namespace

void stop_point() {
    if (listener != nullptr) listener->ask_();
}

StopListener::StopListener(std::function<void()> ask) : ask_(std::move(ask)), before_(std::exchange(listener, this)) {}

StopListener::~StopListener() { listener = before_; }

const StopListener* StopListener::of_this_thread() { return listener; }

SameListener::SameListener(const StopListener* of_caller) : before_(std::exchange(listener, of_caller)) {}

SameListener::~SameListener() { listener = before_; }

} // namespace kaya
