// The model while solve fos tries strengths: what is checked and set before, and restored after.
#pragma once

#include "commands/monitors/progress.hpp"
#include "commands/run/run_cycles.hpp"
#include "commands/session/session.hpp"
#include "commands/stability/reduced_model.hpp"
#include "commands/stability/strength_reduction.hpp"

#include <cstdint>
#include <optional>
#include <utility>

namespace kaya {

/// The model of a session while trials change it; the destructor restores it, and the settings of the deck.
class ModelOnTrial {
public:
    /// `associated`: zones dilate as much as they have friction.
    ModelOnTrial(Session& session, const Asked& asked, bool associated = false);
    ~ModelOnTrial();
    ModelOnTrial(const ModelOnTrial&) = delete;
    ModelOnTrial& operator=(const ModelOnTrial&) = delete;

    /// The state that trials begin with.
    const ReducedModel& initial() const { return initial_; }
    /// Leaves this state in place of the initial one.
    void leave(Model model) { left_ = std::move(model); }

private:
    Session& session_;
    bool energy_;
    Damping damping_;
    double dashpots_;
    ReducedModel initial_;
    std::optional<Model> left_;
};

/// Throws Diagnostic where there is no strength that could be divided, or no damping; warns of strengths that remain.
void check_for_trials(Session& session, const Asked& asked, const Place& place);

/// Throws Diagnostic where no zone yields, or one has no dilation.
void check_for_associated_flow(Session& session, const Place& place);

/// The number of cycles in which the model comes to rest when half of all its inner forces are removed and nothing can fail.
std::int64_t characteristic_span(Session& session, Progress& progress, const RestRatio& ratio, const Place& place);

} // namespace kaya
