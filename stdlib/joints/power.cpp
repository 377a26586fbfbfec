// Joint model `power`: Coulomb slip, and creep in shear below the strength with a rate that is a power of the shear
// stress. docs/joint-models/power.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"
#include "kaya/law/elementary.hpp"
#include "kaya/law/rows.hpp"

namespace {

using namespace kaya::joints::coulomb;
using kaya::joints::exponential;
using kaya::joints::logarithm;

enum OwnProperty : std::size_t {
    dilation_residual = property_count,
    constant_1,
    exponent_1,
    stress_1,
    constant_2,
    exponent_2,
    stress_2,
};

constexpr auto all_properties =
    properties + std::to_array<kaya_jproperty>({
                     {"dilation-residual", "jrdilation", "angle",
                      "angle of dilation after failure; not given: that before", NAN, 0, 89, 1},
                     {"constant-1", "", "length/time/stress^exponent-1",
                      "speed of the first creep at a shear stress of 1", 0, 0, INFINITY, 0},
                     {"exponent-1", "", "-", "power of the shear stress in the first creep", 1, 1, 50, 0},
                     {"stress-1", "", "stress", "shear stress from which the first creep acts", 0, 0, INFINITY, 0},
                     {"constant-2", "", "length/time/stress^exponent-2",
                      "speed of the second creep at a shear stress of 1", 0, 0, INFINITY, 0},
                     {"exponent-2", "", "-", "power of the shear stress in the second creep", 1, 1, 50, 0},
                     {"stress-2", "", "stress", "shear stress from which the second creep acts", 0, 0, INFINITY, 0},
                 });

enum OwnHistory : std::size_t { creep = history_count, dilation_at };

constexpr auto all_history = history +
                             std::to_array<kaya_jhistory>({
                                 {"creep", "length", "the part of the slip that is creep"},
                             }) +
                             history_of_dilation;

/// One of the two creep speeds: constant * stress^exponent from `from` on. By logarithms, so that a large power of a
/// stress in Pa does not overflow before the small constant brings it back.
struct Speed {
    double constant, exponent, from, log_constant, acts;

    Speed(double constant_, double exponent_, double from_)
        : constant(constant_), exponent(exponent_), from(from_), log_constant(std::log(std::max(constant_, 1e-300))),
          acts(constant_ > 0 ? 1 : 0) {}
    /// Speed at a stress above 0 with this logarithm.
    [[gnu::always_inline]] double at(double log_stress) const {
        return acts * exponential(std::min(700.0, std::max(-700.0, log_constant + exponent * log_stress)));
    }
};

constexpr std::size_t together = 32; ///< rows whose creep is computed at once
using Stresses = std::array<double, together>;

/// The stresses at the end of a step that began with the elastic trials: trial = stress + ks dt speed(stress) (2). The difference of the
/// two sides is a decreasing convex function of stress, so Newton's method converges from the trial without passing the root; it ends when
/// no row decreases any more.
void relax(const Stresses& trials, double ks_dt, const Speed low, const Speed high, Stresses& stresses) {
    constexpr double least = 1e-300; // used for 0, which has no logarithm
    stresses = trials;
    for (int k = 0; k < 60; ++k) {
        std::uint64_t moving = 0;
        for (std::size_t j = 0; j < together; ++j) {
            const double stress = stresses[j], some = std::max(stress, least), log_stress = logarithm(some);
            const double first = low.at(log_stress), second = high.at(log_stress);
            const double slope = (low.exponent * first + high.exponent * second) / some;
            const double newton = stress - (stress + ks_dt * (first + second) - trials[j]) / (1 + ks_dt * slope);
            const double next = std::min(stress, std::max(0.0, newton));
            moving |= static_cast<std::uint64_t>(next < stress);
            stresses[j] = next;
        }
        if (moving == 0) break;
    }
}

/// Creep of some rows during one step.
struct Creeps {
    const Speed &low, &high; ///< by the stress from which they act
    double ks_dt;

    /// Stresses at the end of the step for elastic trials.
    void relaxed(const Stresses& trials, Stresses& stresses) const {
        Stresses with_both, with_low;
        relax(trials, ks_dt, low, high, with_both);
        relax(trials, ks_dt, low, Speed(0, 1, 0), with_low);
        // A speed that starts with a jump holds the stress at the jump. Of the solutions with both, one and none of the speeds, the stress
        // is the one in its own range; minima and maxima select it.
        for (std::size_t j = 0; j < together; ++j) {
            const double trial = trials[j];
            const double both = trial > high.from ? with_both[j] : 0;
            const double one = trial > low.from ? with_low[j] : trial;
            const double stress = std::max(both, std::min(high.from, one));
            stresses[j] = std::max(stress, std::min(low.from, trial));
        }
    }
};

/// One row's elastic force after creep, computed before.
struct Relaxed {
    double force;
    bool creeps;

    [[gnu::always_inline]] double relaxed(double trial) const { return creeps ? force : trial; }
};

template <bool dilates> void run_rows(kaya_jbatch* batch, const Values& values, double residual_dilatancy) {
    const double* p = batch->properties;
    const Speed first(p[constant_1], p[exponent_1], p[stress_1]), second(p[constant_2], p[exponent_2], p[stress_2]);
    const bool in_order = first.from <= second.from;
    const Creeps creeps{in_order ? first : second, in_order ? second : first, values.ks * batch->time_step};
    const bool any_creep = first.constant > 0 || second.constant > 0;

    const Columns columns(*batch, dilation_at);
    double* crept = batch->history[creep];
    Stresses trials{}, stresses{};
    for (std::size_t begin = 0; begin < batch->n; begin += together) {
        const std::size_t count = std::min(together, batch->n - begin);
        if (any_creep) {
            trials.fill(0);
            KAYA_INDEPENDENT_ROWS
            for (std::size_t j = 0; j < count; ++j) {
                const std::size_t i = begin + j;
                const double area = columns.area[i], elastic = length(elastic_shear(columns, i, values.ks));
                trials[j] = area > 0 ? elastic / area : 0;
            }
            creeps.relaxed(trials, stresses);
        }
        KAYA_INDEPENDENT_ROWS
        for (std::size_t j = 0; j < count; ++j) {
            const std::size_t i = begin + j;
            const bool failed = columns.states[i] != 0;
            Limits limits = values.limits(failed);
            limits.dilatancy = failed ? residual_dilatancy : values.dilatancy;
            const double area = columns.area[i];
            const Relaxed relaxed{area * stresses[j], any_creep && area > 0};
            const auto outcome =
                step<dilates>(columns, i, values.kn, values.ks, limits, values.line(failed, area), relaxed);
            crept[i] += outcome.excess > 0 ? 0 : outcome.slipped;
        }
    }
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const Values values(p);
    const double residual = std::isnan(p[dilation_residual]) ? values.dilatancy : tan_degrees(p[dilation_residual]);
    if (values.dilatancy > 0 || residual > 0) run_rows<true>(batch, values, residual);
    else run_rows<false>(batch, values, residual);
    return -1;
}

constexpr kaya_jmodel descriptor =
    model("power", "Coulomb slip with power-law creep", all_properties, all_history, run);

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
