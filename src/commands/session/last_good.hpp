// A state in memory from which that before a failed cycle is made again.
#pragma once

#include "io/save.hpp"
#include "model/tables/model.hpp"

#include <chrono>
#include <cstdint>
#include <string>

namespace kaya {

class Session;

/// A cycle that fails midway leaves an unusable model. So the session is copied from time to time while it cycles, and after a failure
/// the copy runs up to the cycle before: with the same bits, since cycles depend on the model only. Copies take at most a hundredth of the
/// time; the cycles in between are repeated once after a failure.
class LastGood {
public:
    using Clock = std::chrono::steady_clock;

    /// The session follows a whole cycle, or before the first: it is copied if it is time for that, or a copy takes at most `always`.
    void offer(Session& session, Clock::duration always = {});
    /// It is copied now.
    void take(Session& session);
    /// Something other than a cycle changes the session: the copy no longer leads to it.
    void lose_track() { leads_here_ = false; }
    /// The model has been saved or discarded.
    void drop();

    bool empty() const { return !taken_; }
    /// It has no blocks.
    bool is_void() const { return model_.blocks.size() == 0; }
    std::int64_t cycle() const { return model_.clock.cycle; }

    /// Cycles the copy up to `cycle`, unless commands or scripts of the session have acted since it was taken. Stops early on request.
    /// Throws Diagnostic when a cycle fails; the copy is then useless.
    void run_on(Session& session, std::int64_t cycle);
    /// Throws Diagnostic (Fault::run). `remark` is shown by `kaya info`.
    void write(const std::string& file, const std::string& remark);

private:
    Model model_;
    SaveExtras extras_;
    bool taken_ = false;
    bool leads_here_ = false; ///< cycles alone lead from the copy to the session
    bool no_memory_ = false;
    Clock::time_point when_{};
    Clock::duration cost_{}; ///< of the last copy
};

} // namespace kaya
