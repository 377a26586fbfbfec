// Points in long work where a stop request is checked.
#pragma once

#include <functional>

namespace kaya {

/// Checks for a request and throws what the listener throws. May be called by any thread that works for the listening one, between parts of work that makes no lasting
/// change before its end. Does nothing without a listener.
void stop_point();

/// Listens while it exists to the thread that constructs it, and to the threads of its parallel loops, in place of the previous listener.
class StopListener {
public:
    explicit StopListener(std::function<void()> ask);
    ~StopListener();
    StopListener(const StopListener&) = delete;
    StopListener& operator=(const StopListener&) = delete;

    static const StopListener* of_this_thread();

private:
    friend void stop_point();
    std::function<void()> ask_;
    const StopListener* before_;
};

/// While it exists, this thread has the listener of the thread that it works for.
class SameListener {
public:
    explicit SameListener(const StopListener* of_caller);
    ~SameListener();
    SameListener(const SameListener&) = delete;
    SameListener& operator=(const SameListener&) = delete;

private:
    const StopListener* before_;
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
