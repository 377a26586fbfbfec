// Waits for locks of a process that was just killed.
#pragma once

#include <chrono>
#include <thread>

namespace kaya {

/// Asks until the answer is true, for half a second: a process that was killed holds its locks until the system has released its memory.
template <class Ask> bool ask_again(Ask ask) {
    constexpr int times = 25;
    for (int k = 0; k < times; ++k) {
        if (ask()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

} // namespace kaya
