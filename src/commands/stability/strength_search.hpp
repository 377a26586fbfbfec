// The trials of solve fos, each of which begins where earlier ones allow it.
#pragma once

#include "commands/stability/model_on_trial.hpp"
#include "commands/stability/strength_trial.hpp"
#include "lang/commands/commands.hpp"

#include <optional>
#include <string>

namespace kaya {

class StrengthSearch {
public:
    StrengthSearch(const TrialBench& bench, ModelOnTrial& model, const lang::Solve& command)
        : bench_(bench), model_(model), command_(command) {}
    ~StrengthSearch();
    StrengthSearch(const StrengthSearch&) = delete;
    StrengthSearch& operator=(const StrengthSearch&) = delete;

    /// The stages of a search. A trial begins
    enum class Stage {
        quick, ///< where the last stable trial with more strength came to rest, or with the initial state; it may end early
        patient,   ///< there as well; its motion is watched for longer
        sliding,   ///< where the model has slid on to, with the forces left by its motion
        from_start ///< with the initial state, and comes nearly to rest after each step of its strength
    };
    void enter(Stage stage) { stage_ = stage; }
    /// Enters the stage `sliding`; false where the model cannot slide on without a trace.
    bool enter_sliding();

    /// Whether a trial may fail for what earlier ones have slipped.
    bool slip_counts() const { return kaya::slip_counts(bench_); }

    /// Whether the model comes to rest with its strength divided by the factor.
    bool stands(double factor);

    /// The expected number of further trials, for the progress line.
    void expect(int more) { expected_ = more; }
    /// The last trial that failed.
    const std::optional<Trial>& failed() const { return failed_; }
    /// The moving bodies of that trial; "" without motion.
    std::string mechanism() const;

private:
    const ReducedModel& beginning(double factor) const;
    void report(const Trial& trial) const;
    std::optional<double> seconds_left() const;

    const TrialBench& bench_;
    ModelOnTrial& model_;
    const lang::Solve& command_;
    Stage stage_ = Stage::quick;
    std::optional<Trial> stable_, failed_;
    std::optional<ReducedModel> sliding_;
    int trials_ = 0, expected_ = 0;
};

} // namespace kaya
