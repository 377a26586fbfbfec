#include "laws/stiffness_trial.hpp"

#include "base/diagnostic.hpp"
#include "laws/lone_row.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

/// One sub-contact, by itself.
struct Bench {
    double area = 1, opening = 0, opening_step = 0, slip = 0, slip_step = 0, none = 0, normal = 0, shear[3] = {0, 0, 0};
    double normal_stiffness = 0, shear_stiffness = 0, work = 0;
    std::uint32_t state = 0;
    std::array<double, KAYA_JMODEL_MAX_HISTORY> history{};
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> columns{};
    JointObject object;
    LoneColumns others;

    kaya_jbatch batch(const JointModel& model, const std::vector<double>& values) {
        for (std::size_t k = 0; k < history.size(); ++k) columns[k] = &history[k];
        kaya_jbatch b{};
        b.n = 1;
        b.properties = values.data();
        b.time_step = 1;
        b.area = &area;
        b.normal_disp = &opening;
        b.normal_disp_inc = &opening_step;
        for (int k = 0; k < 3; ++k) {
            b.shear_disp[k] = k == 0 ? &slip : &none;
            b.shear_disp_inc[k] = k == 0 ? &slip_step : &none;
            b.shear_force[k] = &shear[k];
        }
        b.pore_pressure = &none;
        b.normal_force = &normal;
        b.normal_stiffness = &normal_stiffness;
        b.shear_stiffness = &shear_stiffness;
        b.frictional_work = &work;
        b.state = &state;
        b.history = columns.data();
        b.object = model.keeps_objects() ? object.address() : nullptr;
        b.tables = model.tables;
        others.add_to(b, model);
        return b;
    }
};

} // namespace

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
    // Of the deck's length: from stresses that are small for any joint up to those of a hard one under load.
    constexpr double shifts[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4};
    Bench bench;
    auto batch = bench.batch(model, values);
    if (const auto failure = initialise_fenced(model, batch)) {
        refuse_trespass(model, *failure);
        return std::nullopt;
    }
    std::optional<StiffnessTrial> worst;
    // One step; false when the model refuses it.
    const auto reported = [&] { return std::max(bench.normal_stiffness, bench.shear_stiffness); };
    const auto advance = [&](const char* resists, double& place, double& step, double shift, const double& force) {
        const double before = force, reported_before = reported();
        step = shift;
        const auto failure = run_fenced(model, batch);
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
            if (!advance("closing", bench.opening, bench.opening_step, -shift, bench.normal)) return worst;
            if (!advance("shear", bench.slip, bench.slip_step, shift, bench.shear[0])) return worst;
        }
    return worst;
}

} // namespace kaya
