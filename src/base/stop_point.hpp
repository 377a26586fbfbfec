// Where long work that is deep inside of a command asks whether somebody wants it to stop.
#pragma once

#include <functional>

namespace kaya {

/// Asks; throws what the one that listens throws. May be called by any thread, between parts of work that changes nothing that
/// stays before its end. Nothing happens when nobody listens.
void stop_point();

/// Listens as long as it lives, in the place of whoever did before. To be made and to go while no work is done.
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

/// The same in loops whose parts are small: asks in every so many of them.
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
