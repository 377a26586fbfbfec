#include "joints/stiffness_trial.hpp"

#include "joints/batch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace kaya {

namespace {

/// One sub-contact, by itself.
struct Bench {
    double area = 1, opening = 0, step = 0, none = 0, normal = 0, shear[3] = {0, 0, 0};
    double normal_stiffness = 0, shear_stiffness = 0, work = 0;
    std::uint32_t state = 0;
    std::array<double, KAYA_JMODEL_MAX_HISTORY> history{};
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> columns{};
    JointObject object;

    kaya_jbatch batch(const JointModel& model, const std::vector<double>& values) {
        for (std::size_t k = 0; k < history.size(); ++k) columns[k] = &history[k];
        kaya_jbatch b{};
        b.n = 1;
        b.properties = values.data();
        b.time_step = 1;
        b.area = &area;
        b.normal_disp = &opening;
        b.normal_disp_inc = &step;
        for (int k = 0; k < 3; ++k) {
            b.shear_disp[k] = b.shear_disp_inc[k] = &none;
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
        return b;
    }
};

} // namespace

std::optional<StiffnessTrial> try_stiffness(const JointModel& model, const std::vector<double>& values) {
    constexpr int steps = 4;
    constexpr double closing = 1e-9; // of the deck's length: stresses that are small for any joint
    Bench bench;
    auto batch = bench.batch(model, values);
    if (initialise_batch(model, batch)) return std::nullopt;
    std::optional<StiffnessTrial> worst;
    bench.step = -closing;
    for (int i = 0; i < steps; ++i) {
        const double before = bench.normal, stiffness = bench.normal_stiffness;
        if (run_batch(model, batch)) return std::nullopt;
        bench.opening += bench.step;
        const StiffnessTrial trial{(bench.normal - before) / closing, std::max(stiffness, bench.normal_stiffness)};
        if (!worst || trial.found * worst->reported > worst->found * trial.reported) worst = trial;
    }
    return worst;
}

} // namespace kaya
