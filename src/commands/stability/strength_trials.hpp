// Trials of solve fos: does a model stand with its strength divided by a factor?
#pragma once

#include "commands/stability/failure_mode.hpp"
#include "commands/monitors/failure_monitor.hpp"
#include "commands/monitors/progress.hpp"
#include "commands/monitors/rest_monitor.hpp"
#include "commands/run/run_cycles.hpp"
#include "commands/stability/strength_reduction.hpp"
#include "lang/commands/commands.hpp"

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace kaya {

/// Trials of one model; each begins with its initial state, which is restored after the last.
class StrengthTrials {
public:
    StrengthTrials(Session& session, const lang::Solve& command, const Limits& limits);
    ~StrengthTrials();
    StrengthTrials(const StrengthTrials&) = delete;
    StrengthTrials& operator=(const StrengthTrials&) = delete;

    /// Whether the model comes to rest with its strength divided by the factor. It is stable when the ratio is reached; it fails when its
    /// unbalanced force does not decrease from one span to the next. Starts where the last stable trial with more strength came to rest, or
    /// where the first one started.
    bool stands(double factor);

    /// The expected number of further trials, for the progress line.
    void expect(int more) { expected_ = more; }
    /// Whether the last failed trial was ended early because motion continued.
    bool failed_early() const { return failed_early_; }
    /// From now on trials are watched over three times as many cycles before they end early.
    void be_patient() { patient_ = true; }
    /// From here on no trial ends early, and each starts where the first one did; or, where joints and zones have no history, with the
    /// forces left by their motion.
    void begin_anew();
    /// Whether trials begin where the model has slid on to.
    bool slides() const { return sliding_.has_value(); }
    void forget_sliding() { sliding_.reset(); }
    /// Whether the last stable trial started elsewhere than the first.
    bool has_warm_answer() const { return warm_ && stable_.has_value(); }
    /// The moving bodies of the last failed trial; "" without motion.
    const std::string& mechanism() const { return mechanism_; }
    /// The failure mode of that trial; none where it failed before it reached its factor.
    const std::optional<FailureMode::Shares>& mode() const { return mode_; }

private:
    /// State of a trial.
    struct Outcome {
        std::int64_t cycles = 0;
        bool at_rest = false, tired = false, goes_on = false; ///< tired: the force out of balance does not get smaller
        std::optional<MovingBody> moving;
    };
    /// A state that trials begin or end with, and the values of its property sets before they were divided.
    struct State {
        Model model;
        std::vector<std::vector<double>> whole;
        double factor;
    };
    /// Forces and stresses.
    using Answer = std::tuple<Column<double>, std::array<Column<double>, 3>, Column<Stress>>;

    RestSpan run(std::int64_t cycles, double ratio, FailureMonitor* monitor = nullptr);
    void settle(Outcome& outcome, double factor, double ratio, FailureMonitor* monitor);
    void keep_end(const Outcome& outcome, double factor, const std::optional<FailureMode>& mode);
    bool goes_to_its_end() const;
    bool slides_without_trace();
    Answer answer_of_next_cycle(bool forgets);
    void stop_sliding(double factor);
    std::optional<double> seconds_left() const;
    void lower(double factor);
    void learn_whole_values();
    void go_to(const State& state);
    void go_back(const Model& state);
    void leave(const Model& state);
    void check_strengths(const Place& place);
    std::int64_t characteristic_span(const Place& place);

    Session& session_;
    Asked asked_;
    std::string file_;
    bool keep_;
    double ratio_;
    bool energy_;     ///< as the deck has it
    Damping damping_; ///< so too
    double dashpots_; ///< so too
    Progress progress_;
    Model start_;
    std::optional<State> stable_, failed_;   ///< ends of trials
    std::optional<State> sliding_;           ///< where the model has slid on to after one that failed
    std::vector<Row> slipping_;              ///< sub-contacts that slip there
    std::vector<std::vector<double>> whole_; ///< of the present state
    bool warm_ = true, patient_ = false, failed_early_ = false;
    std::string mechanism_;
    std::optional<FailureMode::Shares> mode_;
    std::int64_t span_ = 0;
    int trials_ = 0, expected_ = 0;
};

} // namespace kaya
