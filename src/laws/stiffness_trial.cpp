#include "laws/stiffness_trial.hpp"

#include "base/diagnostic.hpp"
#include "laws/lone_row.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

void refuse_trespass(const JointModel& model, const BatchFailure& failure) {
    if (!failure.trespass) return;
    Diagnostic error(
        failure.message,
        fmt::format("it was tried on one sub-contact before the run; correct its source: {}", model.file.string()),
        Fault::run);
    error.code = "joint-model-trespass";
    throw error;
}

} // namespace

std::optional<StiffnessTrial> try_stiffness(const JointModel& model, const std::vector<double>& values) {
    // In the deck's unit of length: from stresses that are small for any joint up to those of a stiff one under load.
    constexpr double shifts[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4};
    LoneRow row;
    LoneColumns others;
    auto batch = row.batch(model, values, 1, others);
    if (const auto failure = initialise_batch(model, batch)) {
        refuse_trespass(model, *failure);
        return std::nullopt;
    }
    std::optional<StiffnessTrial> worst;
    // One step; false when the model refuses it.
    const auto reported = [&] { return std::max(row.normal_stiffness, row.shear_stiffness); };
    const auto advance = [&](const char* resists, double& place, double& step, double shift, const double& force) {
        const double before = force, reported_before = reported();
        step = shift;
        const auto failure = run_batch(model, batch, nullptr, Guard::fenced);
        if (failure) refuse_trespass(model, *failure);
        const bool well = !failure;
        place += step;
        step = 0;
        if (!well) return false;
        const StiffnessTrial trial{resists, (std::abs(force) - std::abs(before)) / std::abs(shift),
                                   std::max(reported_before, reported())};
        if (!worst || trial.found * worst->reported > worst->found * trial.reported) worst = trial;
        return true;
    };
    for (const double shift : shifts)
        for (int i = 0; i < 2; ++i) {
            if (!advance("closing", row.normal_disp, row.normal_disp_inc, -shift, row.normal_force)) return worst;
            if (!advance("shear", row.shear_disp[0], row.shear_disp_inc[0], shift, row.shear_force[0])) return worst;
        }
    return worst;
}

} // namespace kaya
