// One sub-contact without an engine: a joint model is driven step by step, and steps can be tried.
#pragma once

#include "laws/batch.hpp"
#include "laws/joint_model.hpp"
#include "laws/lone_row.hpp"

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace kaya {

/// Relative displacement of the sides in one step: opening positive, two directions of shear.
struct JointStep {
    double opening = 0;
    std::array<double, 2> shear{};
    double time = 0; ///< duration of the step
};

/// A sub-contact with its joint model. The normal is z, shear is x and y.
class SingleJoint : public LoneRow {
public:
    /// `values` in the order of the model's table. Throws Diagnostic for values that are missing or cannot work together.
    SingleJoint(const JointModel& model, std::vector<double> values, double area);

    /// Throws Diagnostic (Fault::run) with the model's own sentence when the model fails.
    void step(const JointStep& step);

    /// The step with the opening that makes the normal stress `stress` at its end; its `opening` is where the search
    /// begins. Throws Diagnostic when no opening does.
    void step_to_stress(double stress, JointStep step);

    double normal_stress() const { return normal_force / area; }
    /// On the side that is moved, against the motion: positive when it resists.
    std::array<double, 2> shear_resistance() const { return {-shear_force[0] / area, -shear_force[1] / area}; }

    const JointModel* model;
    std::shared_ptr<const std::vector<double>> values; ///< shared by the copies that are tried

    /// A copy in the same state for a trial step; writes outside its columns are not checked.
    SingleJoint trial() const {
        SingleJoint copy = *this;
        copy.fenced_ = false;
        return copy;
    }

private:
    bool fenced_ = true;
    void call(const JointStep& step, bool initialise);
};

/// Why the model fails on a sub-contact without area, such as a corner in contact; empty when it does not fail.
std::string fault_without_area(const JointModel& model, const std::vector<double>& values);

/// The zero of `over`, which decreases with the opening, or its nearest point at a jump; `start` is a guess and `unit` a length of the
/// problem. False when there is none.
bool find_opening(const std::function<double(double)>& over, double start, double unit, double stress_scale,
                  double& opening);

} // namespace kaya
