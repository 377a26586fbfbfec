#include "jointtest/single_joint.hpp"

#include "base/diagnostic.hpp"
#include "laws/lone_row.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

SingleJoint::SingleJoint(const JointModel& model_, std::vector<double> values_, double area_)
    : model(&model_), values(std::make_shared<const std::vector<double>>(std::move(values_))) {
    area = area_;
    if (const auto missing = model->missing(*values); !missing.empty())
        throw Diagnostic(fmt::format("joint model {} lacks {}", model->name, fmt::join(missing, ", ")),
                         fmt::format("give it after the name: {}=1e5", missing.front()));
    if (const auto fault = model->check(*values); !fault.empty())
        throw Diagnostic(fmt::format("joint model {}: {}", model->name, fault), "correct the values");
    call({}, true);
}

void SingleJoint::call(const JointStep& step, bool initialise) {
    normal_disp_inc = step.opening;
    shear_disp_inc = {step.shear[0], step.shear[1], 0};
    LoneColumns others;
    auto batch = this->batch(*model, *values, step.time, others);
    const auto failure = initialise ? initialise_batch(*model, batch)
                                    : run_batch(*model, batch, nullptr, fenced_ ? Guard::fenced : Guard::all);
    if (failure)
        throw Diagnostic(failure->message,
                         fmt::format("normal displacement {:g}, shear displacement {:g} {:g}", normal_disp,
                                     shear_disp[0], shear_disp[1]),
                         Fault::run);
}

void SingleJoint::step(const JointStep& step) {
    call(step, false);
    normal_disp += step.opening;
    for (int k = 0; k < 2; ++k) shear_disp[k] += step.shear[k];
}

void SingleJoint::step_to_stress(double stress, JointStep step) {
    const auto over = [&](double opening) {
        SingleJoint trial = this->trial();
        JointStep tried = step;
        tried.opening = opening;
        trial.step(tried);
        return trial.normal_stress() - stress;
    };
    const double scale = std::abs(stress) + std::abs(normal_stress());
    if (!find_opening(over, step.opening, scale / std::max(normal_stiffness, 1e-300), scale, step.opening))
        throw Diagnostic(fmt::format("joint model {} cannot carry a normal stress of {:g} here", model->name, stress),
                         "a joint without tension carries none below 0; look at the path");
    this->step(step);
}

std::string fault_without_area(const JointModel& model, const std::vector<double>& values) {
    try {
        SingleJoint joint(model, values, 0);
        const double shift = 1e-6 / std::max(1.0, std::abs(joint.normal_disp));
        joint.step({-shift, {shift, 0}, 0});
        joint.step({2 * shift, {0, shift}, 0});
        return {};
    } catch (const Diagnostic& failure) {
        return fmt::format("without an area, as a corner that just touches: {}", failure.message);
    }
}

bool find_opening(const std::function<double(double)>& over, double start, double unit, double stress_scale,
                  double& opening) {
    constexpr int most_doublings = 200;
    const double exact = 1e-14 * stress_scale;
    double closed = start, open = start, at_closed = over(start), at_open = at_closed;
    // Slightly beyond the opening that the stiffness predicts.
    const double by_stiffness = stress_scale > 0 ? 1.1 * unit * std::abs(at_closed) / stress_scale : 0;
    double width = std::max({by_stiffness, 1e-12 * unit, 1e-15});
    for (int k = 0; at_closed < 0; ++k, width *= 2) {
        if (k == most_doublings) return false;
        open = closed, at_open = at_closed;
        at_closed = over(closed -= width);
    }
    for (int k = 0; at_open > 0; ++k, width *= 2) {
        if (k == most_doublings) return false;
        closed = open, at_closed = at_open;
        at_open = over(open += width);
    }
    // False position, with halves in between so that kinks and jumps end it too.
    for (int k = 0; k < 200 && at_closed > exact && at_open < -exact; ++k) {
        const double by_line = closed + (open - closed) * (at_closed / (at_closed - at_open));
        const double middle = k % 3 == 2 ? 0.5 * (closed + open) : by_line;
        if (middle <= closed || middle >= open) break;
        const double value = over(middle);
        if (value >= 0) closed = middle, at_closed = value;
        else open = middle, at_open = value;
    }
    opening = std::abs(at_closed) <= std::abs(at_open) ? closed : open;
    return true;
}

} // namespace kaya
