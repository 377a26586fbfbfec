#include "base/stop_point.hpp"

#include <atomic>
#include <utility>

namespace kaya {

namespace {

std::atomic<StopListener*> listener = nullptr;

} // namespace

void stop_point() {
    if (const StopListener* now = listener.load(std::memory_order_acquire)) now->ask_();
}

StopListener::StopListener(std::function<void()> ask) : ask_(std::move(ask)), before_(listener.exchange(this)) {}

StopListener::~StopListener() { listener = before_; }

} // namespace kaya
