// Progress display of a run.
#pragma once

#include "commands/output.hpp"
#include "model/model.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace kaya {

/// At what a run is going to stop, as far as it can be told beforehand.
struct Target {
    std::optional<std::int64_t> cycle;  ///< number of the last cycle
    std::optional<double> time;         ///< model time
    std::string task = {};              ///< what the run does, in front of the line
    std::optional<double> seconds = {}; ///< since the start of the run
};

/// Shows cycle, time, ratio, cycles per second and time left: in place, five times a second, on a
/// terminal; as a line every ten seconds elsewhere.
class Progress {
public:
    Progress(Output& output, const Model& model, const Target& target);

    /// To be called after each cycle. Looks at the clock seldom enough to cost nothing; returns whether it did.
    bool advanced();

    /// Another task of the same run, and how long the run will still take where that is known.
    void expect(std::string task, std::optional<double> seconds_left);

    /// Seconds since the start, at the last look at the clock.
    double seconds() const { return seconds_; }

    /// Takes the line away and says what was done.
    void finish();

private:
    void update();
    std::string line() const;
    double left() const; ///< seconds, negative when it cannot be told

    Output& output_;
    const Model& model_;
    Target target_;
    std::chrono::steady_clock::time_point start_;
    std::int64_t done_ = 0; ///< cycles; a search for a factor of safety goes back to earlier ones
    double first_time_;
    std::int64_t until_check_ = 1, stride_ = 1; ///< cycles
    double seconds_ = 0, shown_ = 0;
};

/// 75 -> "1:15", 4000 -> "1:06:40".
/// The time of the model, with "(scaled)" after it where density scaling has changed masses.
std::string time_text(const Model& model);

/// What density scaling has done, in words; empty where it has changed no mass.
std::string scaling_text(const Model& model);

std::string duration_text(double seconds);

} // namespace kaya
