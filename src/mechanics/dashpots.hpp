// Viscous forces that follow the stiffness of joints and zones: docs/theory/damping.md.
#pragma once

#include "mechanics/batches.hpp"
#include "model/model.hpp"
#include "model/rayleigh.hpp"

#include <vector>

namespace kaya {

/// True when joints carry viscous forces besides those of their law.
bool joints_are_damped(const Settings& settings);

/// True when zones do.
inline bool zones_are_damped(const Model& model) {
    return stiffness_damping(model.settings) > 0 && model.zones.keeps_dashpots;
}

/// Where nothing is damped so any more, the viscous forces of the last step are gone.
void drop_idle_dashpots(Model& model);

/// Times by which the rates of normal and shear force are multiplied in one contact: its dashpots are these times its
/// springs.
struct Beta {
    double normal = 0, shear = 0;
};

/// Of the settings and of the contact's own dashpots; the stiffness is the one of now, masses are inertial.
Beta beta_of(const Model& model, Row contact);

/// Dashpots of one batch in one step. The constructor is called when the increments are known and the joint
/// model has not run yet, finish() when it has.
class BatchDashpots {
public:
    /// `friction` is room for the frictional work of the batch before its joint model runs.
    BatchDashpots(Model& model, const Batch& batch, std::vector<double>& friction);
    /// Writes SubContacts::dashpot_normal and dashpot_shear. Returns the energy that was taken up in the step, but for
    /// overlaps: JointWork::dashpots has theirs.
    double finish();

private:
    /// Of the dashpots as they are on the increments, but for overlaps.
    double work() const;

    Model& model_;
    const Batch& batch_;
    double taken_ = 0;
    std::vector<double>& friction_;
};

} // namespace kaya
