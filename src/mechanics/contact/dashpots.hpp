// Viscous forces that follow the stiffness of joints and zones: docs/theory/damping.md.
#pragma once

#include "mechanics/contact/batches.hpp"
#include "model/tables/model.hpp"
#include "model/measure/rayleigh.hpp"

#include <vector>

namespace kaya {

/// True when zones do.
inline bool zones_are_damped(const Model& model) {
    return stiffness_damping(model.settings) > 0 && model.zones.keeps_dashpots;
}

/// Clears the viscous forces of the last step where damping has ended.
void drop_idle_dashpots(Model& model);

/// Factors of the rates of normal and shear force in one contact: its dashpots are these multiples of its springs.
struct Beta {
    double normal = 0, shear = 0;
};

/// From the settings and the contact's own dashpots; with present stiffness and inertial masses.
Beta beta_of(const Model& model, Row contact);

/// Dashpots of one batch in one step. Constructed when the increments are known, before the joint model runs; finish() is called after it.
class BatchDashpots {
public:
    /// `friction` is scratch memory for the frictional work of the batch before its joint model runs.
    BatchDashpots(Model& model, const Batch& batch, std::vector<double>& friction);
    /// Writes SubContacts::dashpot_normal and dashpot_shear. Returns the energy dissipated in the step, without overlaps, which
    /// JointWork::dashpots holds.
    double finish();

private:
    /// Work of the present dashpots on the increments, without overlaps.
    double work() const;

    Model& model_;
    const Batch& batch_;
    double taken_ = 0;
    std::vector<double>& friction_;
};

} // namespace kaya
