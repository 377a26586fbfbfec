// One trial of solve fos: a model, a factor, and whether the model comes to rest with its strength divided by the factor.
#pragma once

#include "commands/monitors/progress.hpp"
#include "commands/monitors/rest_monitor.hpp"
#include "commands/run/run_cycles.hpp"
#include "commands/session/session.hpp"
#include "commands/stability/failure_mode.hpp"
#include "commands/stability/reduced_model.hpp"
#include "commands/stability/strength_reduction.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace kaya {

/// Shared by all trials of a search.
struct TrialBench {
    Session& session; ///< its model is the place of work: what it holds between trials does not matter
    const Asked& asked;
    const ReducedModel& initial;
    RestRatio ratio;   ///< of a model at rest
    std::int64_t span; ///< cycles in which the model would come to rest if nothing could fail
    Progress& progress;
};

/// How a trial is run.
struct TrialRule {
    double window;        ///< spans over which motion must continue to end a trial early
    bool ends_with_bolts; ///< a model with bolts may end early as well
    bool settles_between; ///< the model comes nearly to rest after each step of its strength
};

struct Trial {
    bool stands = false;
    bool goes_on = false; ///< ended early because motion continued
    double began = 0;     ///< by which the strength was divided where it began
    std::int64_t cycles = 0;
    std::optional<MovingBody> moving;
    std::string crushed;                     ///< the zone that was crushed, and ended it; empty: none
    std::optional<FailureMode::Shares> mode; ///< of a failed trial; none where it failed before it reached its factor
    ReducedModel end;
};

/// The model is stable when its ratio of unbalanced force is reached; it fails when that force does not decrease from one span to the next,
/// and where a zone is crushed.
/// The strength is lowered in steps from that of `start`, or from 1; a start in motion is stopped at once.
Trial run_trial(const TrialBench& bench, const ReducedModel& start, double factor, const TrialRule& rule);

/// Whether a joint of the model loses strength as it slips, or divides its own one, which may follow its slip.
bool slip_counts(const TrialBench& bench);

/// The initial state once it has come to rest with its strength as it is; none where it does not.
std::optional<ReducedModel> brought_to_rest(const TrialBench& bench);

/// Lets a model slide on from the end of a trial that failed, with less strength, until shear that loading had locked into its joints has
/// turned into the direction of slip. None where it topples or crushes a zone, or where joints or zones are weaker or stronger by it.
std::optional<ReducedModel> slide_on(const TrialBench& bench, const ReducedModel& failed);

} // namespace kaya
