// Cycling until something is reached.
#pragma once

#include "commands/monitors/rest_monitor.hpp"
#include "commands/session/session.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace kaya {

class FailureMonitor;
class Progress;

/// Where a run stops: at the first of these that is reached, or when all of them are.
struct Limits {
    std::optional<std::int64_t> cycles; ///< from now on
    std::optional<double> time;         ///< from now on
    std::optional<double> ratio, maximum_ratio, local_ratio, force;
    std::optional<double> clock;            ///< seconds
    bool still = false;                     ///< ratios and force count only when no body gains displacement any more
    bool all = false;                       ///< all limits must be reached
    std::int64_t calm = 0;                  ///< all motion is stopped each time after so many cycles; 0: never
    std::function<std::string()> ends = {}; ///< called after each cycle: the reason to stop there, empty to continue
};

/// Lets joint models take up forces set by scripts and commands, and warns of those that they cannot carry. Returns whether forces changed.
bool settle_forces(Session& session);

/// The reason for the end of a run, in words, and whether a ratio or a force fell below its limit.
struct RunEnd {
    std::string why;
    bool at_rest = false;
    std::string fallen = {}; ///< names the bodies that fall past all others, if they are the reason
};

/// Runs until a limit is reached; returns which. A watch sees every cycle.
RunEnd advance_until(Session& session, const Limits& limits, RestMonitor* monitor = nullptr);

/// Result of a number of cycles.
struct RestSpan {
    bool at_rest = false;             ///< the ratio was reached, and nothing moved on for a while; the span ended there
    double mean_ratio = 0;            ///< average ratio of unbalanced force, over the cycles
    std::int64_t cycles = 0;          ///< that were run
    std::optional<MovingBody> moving; ///< the ratio was reached, but this body moves on
    bool fails = false;               ///< reported by the failure monitor; the span ended there
};

/// A ratio of unbalanced force, and its value at rest.
struct RestRatio {
    double limit;
    double Clock::*kind = &Clock::average_ratio;

    double now(const Clock& clock) const { return clock.*kind; }
};

/// Prepares the model for a run and warns of what is doubtful in it. Throws Diagnostic where it cannot run.
void make_ready(Session& session);

/// For trials of a model that is ready: nothing is said of their strengths. Cycles until the ratio is at most `ratio` and no body gains
/// displacement, or until that many cycles are done; checking bodies may take more. A monitor sees every cycle.
RestSpan advance_span(Session& session, std::int64_t cycles, const RestRatio& ratio, FailureMonitor* monitor,
                      Progress* progress);

/// Gives joints a cohesion and a tensile strength that nothing reaches, for as long as it lives. Contacts must have their
/// properties: Cycle::prepare.
class ElasticJoints {
public:
    explicit ElasticJoints(Session& session);
    ~ElasticJoints();
    ElasticJoints(const ElasticJoints&) = delete;
    ElasticJoints& operator=(const ElasticJoints&) = delete;

    /// False when no joint model has such a strength: the first run is then like the second.
    bool strengthened() const { return strengthened_; }
    /// Joint models in use whose joints slip and open as ever, since they have another strength.
    const std::set<std::string>& breakable() const { return breakable_; }

private:
    bool strengthened_ = false;
    std::set<std::string> breakable_;
    Session& session_;
    std::vector<std::vector<double>> true_values_;
};

} // namespace kaya
