// Points in long work where a stop request is checked.
#pragma once

#include <functional>

namespace kaya {

/// Checks for a request and throws what the listener throws. May be called by any thread, between parts of work that makes no lasting
/// change before its end. Does nothing without a listener.
void stop_point();

/// Listens while it exists, in place of the previous listener. Construct and destroy it while no work runs.
class StopListener {
public:
    explicit StopListener(std::function<void()> ask);
    ~StopListener();
    StopListener(const StopListener&) = delete;
    StopListener& operator=(const StopListener&) = delete;

private:
    friend void stop_point();
    std::function<void()> ask_;
    StopListener* before_;
};

/// The same in loops with small parts: checks every few parts.
class StopPoints {
public:
    explicit StopPoints(int every = 1024) : every_(every), left_(every) {}
    void pass() {
        if (--left_ > 0) return;
        left_ = every_;
        stop_point();
    }

private:
    int every_, left_;
};

} // namespace kaya
