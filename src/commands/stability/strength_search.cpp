#include "commands/stability/strength_search.hpp"

#include "base/counted.hpp"
#include "commands/run/files.hpp"

#include <array>
#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace {

/// By StrengthSearch::Stage.
constexpr std::array<TrialRule, 4> rules{{
    {.window = 2.0 / 3, .ends_with_bolts = true, .settles_between = false},
    {.window = 5, .ends_with_bolts = false, .settles_between = false},
    {.window = 5, .ends_with_bolts = false, .settles_between = false},
    {.window = 5, .ends_with_bolts = false, .settles_between = true},
}};

} // namespace

StrengthSearch::~StrengthSearch() {
    if (command_.keep && failed_) model_.leave(std::move(failed_->end.model));
}

bool StrengthSearch::stands(double factor) {
    bench_.progress.expect(fmt::format("strength divided by {:.6g}", factor), seconds_left());
    ++trials_;
    Trial trial = run_trial(bench_, beginning(factor), factor, rules[static_cast<std::size_t>(stage_)]);
    report(trial);
    const bool stands = trial.stands;
    if (!stands) failed_ = std::move(trial);
    else if (!stable_ || factor > stable_->end.factor) stable_ = std::move(trial);
    return stands;
}

const ReducedModel& StrengthSearch::beginning(double factor) const {
    const bool warm = stage_ == Stage::quick || stage_ == Stage::patient;
    if (warm && stable_ && factor > stable_->end.factor) return stable_->end;
    return stage_ == Stage::sliding ? *sliding_ : bench_.initial;
}

bool StrengthSearch::enter_sliding() {
    sliding_ = failed_ && failed_->crushed.empty() ? slide_on(bench_, failed_->end) : std::nullopt;
    if (sliding_) enter(Stage::sliding);
    return sliding_.has_value();
}

void StrengthSearch::report(const Trial& trial) const {
    const Model& model = trial.end.model;
    bench_.session.program.output.say(fmt::format("strength divided by {:.6g}: {} after {}, ratio {:.3e}{}",
                                                  trial.end.factor, trial.stands ? "stands" : "fails",
                                                  counted(trial.cycles, "cycle"), bench_.ratio.now(model.clock),
                                                  !trial.crushed.empty() ? "; " + trial.crushed
                                                  : trial.moving  ? "; " + body_text(model, *trial.moving) + " moves on"
                                                  : trial.goes_on ? "; it keeps moving and does not slow down"
                                                                  : ""));
    if (!trial.stands && !command_.file.empty()) save_as(bench_.session, command_.file);
}

std::string StrengthSearch::mechanism() const {
    return failed_ ? farthest_text(bench_.initial.model, failed_->end.model, failed_->end.factor) : "";
}

/// At the rate of the trials so far; none where that is unknown.
std::optional<double> StrengthSearch::seconds_left() const {
    if (trials_ == 0 || expected_ == 0) return std::nullopt;
    return bench_.progress.seconds() / trials_ * expected_;
}

} // namespace kaya
