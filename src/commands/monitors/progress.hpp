// Progress display of a run.
#pragma once

#include "commands/program/output.hpp"
#include "model/tables/model.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace kaya {

/// The expected end of a run, as far as it is known.
struct Target {
    std::optional<std::int64_t> cycle;  ///< number of the last cycle
    std::optional<double> time;         ///< model time
    std::string task = {};              ///< the task, shown before the line
    std::optional<double> seconds = {}; ///< since the start of the run
};

/// Shows cycle, time, ratio, cycles per second and time left: in place, five times a second, on a
/// terminal; as a line every ten seconds elsewhere.
class Progress {
public:
    Progress(Output& output, const Model& model, const Target& target);

    /// Call after each cycle. Checks the clock rarely enough to cost nothing; returns whether it did.
    bool advanced();

    /// Sets another task of the same run, and the remaining time where it is known.
    void expect(std::string task, std::optional<double> seconds_left);

    /// Seconds from the start to the last check of the clock.
    double seconds() const { return seconds_; }

    /// Clears the line and reports what was done.
    void finish();

private:
    void update();
    std::string line() const;
    double left() const; ///< seconds, negative when unknown

    Output& output_;
    const Model& model_;
    Target target_;
    std::chrono::steady_clock::time_point start_;
    std::int64_t done_ = 0; ///< cycles; a search for a factor of safety returns to earlier ones
    double first_time_;
    std::int64_t until_check_ = 1, stride_ = 1; ///< cycles
    double seconds_ = 0, shown_ = 0;
};

/// 75 -> "1:15", 4000 -> "1:06:40".
/// The time of the model, with "(scaled)" after it where density scaling has changed masses.
std::string time_text(const Model& model);

/// The effect of density scaling, in words; empty if no mass was changed.
std::string scaling_text(const Model& model);

std::string duration_text(double seconds);

} // namespace kaya
