#include "laws/stiffness_trial.hpp"

#include "base/diagnostic.hpp"
#include "laws/arithmetic.hpp"
#include "laws/lone_row.hpp"
#include "system/crash_report.hpp"

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

namespace {

/// A model stiffer than it reports makes the run unstable. A factor of two is beyond any step of a curved law.
std::string too_soft(const JointModel& model, const std::vector<double>& values) {
    const auto trial = try_stiffness(model, values);
    if (!trial || trial->found <= 2 * trial->reported) return {};
    return fmt::format("it resists {} with a stiffness of {:.4g}, and reports {:.4g}", trial->resists, trial->found,
                       trial->reported);
}

} // namespace

JointStiffness initial_stiffness(const JointModel& model, const std::vector<double>& values) {
    JointStiffness stiffness{std::nan(""), std::nan("")};
    std::string reason;
    try {
        const AtWork at_work(model.who(), "max_stiffness");
        ArithmeticGuard arithmetic;
        model.functions().max_stiffness(values.data(), &stiffness.normal, &stiffness.shear);
        model.note_arithmetic(arithmetic.put_back());
    } catch (const std::exception& thrown) {
        reason = fmt::format("it threw an exception: {}", thrown.what());
    } catch (...) { reason = "it threw an exception"; }
    if (reason.empty() && !(std::isfinite(stiffness.normal) && stiffness.normal > 0))
        reason = fmt::format("the normal stiffness is {}; it must be above 0", stiffness.normal);
    if (reason.empty() && !(std::isfinite(stiffness.shear) && stiffness.shear >= 0))
        reason = fmt::format("the shear stiffness is {}; it must not be below 0", stiffness.shear);
    if (reason.empty()) reason = too_soft(model, values);
    if (reason.empty()) return stiffness;
    Diagnostic error(fmt::format("joint model {} gives no stiffness to compute a time step from", model.name),
                     "give the joint its stiffnesses, or correct max_stiffness() of the model", Fault::run);
    error.code = "joint-model-stiffness";
    throw error.add(reason);
}

} // namespace kaya
