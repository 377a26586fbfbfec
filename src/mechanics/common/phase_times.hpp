// Time spent in the phases of the cycle.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace kaya {

enum class Phase { move, joints, zones, structures, search, gather, step, scripts };

/// Seconds spent in a phase since the program started, for `list timing`.
struct PhaseTime {
    const char* phase;
    double seconds = 0;
    std::int64_t calls = 0;
};

class PhaseTimes {
public:
    /// Calls a phase and adds its time.
    template <class Call> auto timed(Phase phase, Call call) {
        struct Stop {
            PhaseTime& time;
            std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
            ~Stop() {
                time.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
                ++time.calls;
            }
        } stop{all_[static_cast<std::size_t>(phase)]};
        return call();
    }
    const std::vector<PhaseTime>& all() const { return all_; }

private:
    std::vector<PhaseTime> all_{{"move bodies"},     {"contacts and joint models"}, {"zone models"},
                                {"structures"},      {"search contacts"},           {"gather forces"},
                                {"time step limit"}, {"hooks and histories"}}; ///< as in Phase
};

} // namespace kaya
