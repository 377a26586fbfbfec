// Length of the next step: docs/theory/time-step.md.
// reads: sub_contacts.normal_stiffness, sub_contacts.shear_stiffness, gridpoints.zone_frequency, blocks.inertial_mass, gridpoints.inertial_mass, settings.given_time_step
// writes: clock.time_step, settings.energy, and where density is scaled what density_scaling.hpp does
#pragma once

#include "mechanics/step/stiffness_forecast.hpp"
#include "mechanics/contact/batches.hpp"
#include "mechanics/step/step_bounds.hpp"

#include <string>

namespace kaya {

/// Writes Clock::time_step and, where density is scaled, inertial masses. The step depends only on the state in the
/// cycles in which it is computed.
class TimeStep {
public:
    /// The bodies to be checked: those on the marked contacts and their neighbours, or all; and whether the step may increase.
    enum class Bodies { marked, all, all_and_grow };

    /// Clears the marks. Throws Diagnostic when the step that the deck gives is too long.
    void limit(Model& model, const Adjacency& adjacency, std::vector<char>& changed, Bodies bodies);

    /// Whether the step may have to be shorter though no stiffness has changed yet.
    bool forecasts() const { return ahead_.needed(); }
    void take(const Model& model, std::vector<Batch>& batches) { ahead_.take(model, batches); }
    void take(const std::vector<ElasticConstants>& of_blocks) { bounds_.of_zones = &of_blocks; }
    void forget() { ahead_.forget(); }

    /// Throws Diagnostic (Fault::run) when the step is longer than the bound allows and energy has been made.
    void audit(const Model& model) const;

    /// The body that limits the time step and why, in words.
    std::string report(const Model& model, const Adjacency& adjacency);

private:
    void limit_bodies(Model& model, const Adjacency& adjacency, std::vector<char>& changed, Bodies bodies);
    double fit_masses(Model& model, const Adjacency& adjacency, bool anew);
    void take_given(Model& model, const Adjacency& adjacency, double stable, double of_members, bool all);

    double without_growth(const Model& model, const Adjacency& adjacency, double step, StiffnessForecast::Of of);

    StepBounds bounds_;
    StiffnessForecast ahead_;
    bool beyond_bound_ = false; ///< the deck gives a step that only the estimate allows
};

} // namespace kaya
