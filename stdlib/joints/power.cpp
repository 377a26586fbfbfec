// Joint model `power`: Coulomb slip, and creep in shear below the strength with a rate that is a power of the shear
// stress. docs/joint-models/power.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"

#include <iterator>

namespace {

using namespace kaya::joints;
using coulomb::tan_degrees;

enum Property {
    stiffness_normal,
    stiffness_shear,
    friction,
    cohesion,
    tension,
    dilation,
    dilation_zero,
    friction_residual,
    cohesion_residual,
    tension_residual,
    dilation_residual,
    constant_1,
    exponent_1,
    stress_1,
    constant_2,
    exponent_2,
    stress_2,
    property_count
};

constexpr kaya_jproperty properties[] = {
    coulomb::stiffness_normal_row,
    coulomb::stiffness_shear_row,
    coulomb::friction_row,
    coulomb::cohesion_row,
    coulomb::tension_row,
    coulomb::dilation_row,
    coulomb::dilation_zero_row,
    coulomb::friction_residual_row,
    coulomb::cohesion_residual_row,
    coulomb::tension_residual_row,
    {"dilation-residual", "jrdilation", "angle", "angle of dilation after failure; not given: that before", NAN, 0, 89,
     1},
    {"constant-1", "", "length/time/stress^exponent-1", "speed of the first creep at a shear stress of 1", 0, 0,
     INFINITY, 0},
    {"exponent-1", "", "-", "power of the shear stress in the first creep", 1, 1, 50, 0},
    {"stress-1", "", "stress", "shear stress from which the first creep acts", 0, 0, INFINITY, 0},
    {"constant-2", "", "length/time/stress^exponent-2", "speed of the second creep at a shear stress of 1", 0, 0,
     INFINITY, 0},
    {"exponent-2", "", "-", "power of the shear stress in the second creep", 1, 1, 50, 0},
    {"stress-2", "", "stress", "shear stress from which the second creep acts", 0, 0, INFINITY, 0},
};
static_assert(std::size(properties) == property_count);

enum History { gap, slip, creep, history_count };

constexpr kaya_jhistory history[] = {
    coulomb::gap_row,
    coulomb::slip_row,
    {"creep", "length", "the part of the slip that is creep"},
};
static_assert(std::size(history) == history_count);

/// One of the two creep speeds: constant * stress^exponent from `from` on. By logarithms, so that a large power of a
/// stress in Pa does not overflow before the small constant brings it back.
struct Speed {
    double constant, exponent, from, log_constant;

    Speed(double constant_, double exponent_, double from_)
        : constant(constant_), exponent(exponent_), from(from_), log_constant(std::log(constant_)) {}
    double at(double stress) const {
        return constant > 0 && stress > 0 ? std::exp(log_constant + exponent * std::log(stress)) : 0;
    }
    double slope(double stress) const { return stress > 0 ? exponent * at(stress) / stress : 0; }
};

/// The stress at the end of a step that began with the elastic trial: trial = stress + ks dt speed(stress) (2). The
/// left side minus the right is a falling convex function of stress, so Newton's method comes down from the trial
/// without passing the root.
double relaxed(double trial, double ks_dt, const Speed& one, const Speed* other) {
    double stress = trial;
    for (int k = 0; k < 60; ++k) {
        const double speed = one.at(stress) + (other ? other->at(stress) : 0);
        const double slope = one.slope(stress) + (other ? other->slope(stress) : 0);
        const double next = std::max(0.0, stress - (stress + ks_dt * speed - trial) / (1 + ks_dt * slope));
        if (!(next < stress)) break;
        stress = next;
    }
    return stress;
}

/// Creep of one row during one step.
struct Creep {
    const Speed &low, &high; ///< by the stress from which they act
    double ks_dt, area;

    double relaxed(double force) const {
        if (!(area > 0) || (low.constant == 0 && high.constant == 0)) return force;
        const double trial = force / area;
        // A speed that starts with a jump holds the stress at the jump: of the solutions with both, one and none of
        // the speeds the one that lies in its own range is the stress, and minima and maxima pick it.
        const double with_both = trial > high.from ? ::relaxed(trial, ks_dt, low, &high) : 0;
        const double with_low = trial > low.from ? ::relaxed(trial, ks_dt, low, nullptr) : trial;
        const double stress = std::max(with_both, std::min(high.from, with_low));
        return area * std::max(stress, std::min(low.from, trial));
    }
};

ptrdiff_t initialise(kaya_jbatch* batch) {
    coulomb::initialise(*batch, gap, batch->properties[stiffness_normal], batch->properties[stiffness_shear]);
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const double kn = p[stiffness_normal], ks = p[stiffness_shear];
    const double peak_friction = tan_degrees(p[friction]);
    const double residual_friction =
        std::isnan(p[friction_residual]) ? peak_friction : tan_degrees(p[friction_residual]);
    const double peak_dilatancy = tan_degrees(p[dilation]);
    const double residual_dilatancy =
        std::isnan(p[dilation_residual]) ? peak_dilatancy : tan_degrees(p[dilation_residual]);
    const double last_dilation = p[dilation_zero] > 0 ? p[dilation_zero] : INFINITY;
    const Speed first(p[constant_1], p[exponent_1], p[stress_1]), second(p[constant_2], p[exponent_2], p[stress_2]);
    const bool in_order = first.from <= second.from;

    const coulomb::Columns columns(*batch, gap, slip);
    double* crept = batch->history[creep];
    for (std::size_t i = 0; i < batch->n; ++i) {
        const bool failed = columns.states[i] != 0;
        const double area = columns.area[i];
        const coulomb::Line strength{(failed ? p[cohesion_residual] : p[cohesion]) * area,
                                     failed ? residual_friction : peak_friction};
        const Creep creeps{in_order ? first : second, in_order ? second : first, ks * batch->time_step, area};
        const auto outcome = coulomb::step(columns, i, kn, ks,
                                           {failed ? p[tension_residual] : p[tension], p[tension_residual],
                                            failed ? residual_dilatancy : peak_dilatancy, last_dilation},
                                           strength, creeps);
        if (!outcome.slips) crept[i] += outcome.slipped;
    }
    return -1;
}

const char* check(const double* p) {
    if (const char* fault = coulomb::fault_of_stiffness(p[stiffness_normal], p[stiffness_shear])) return fault;
    return coulomb::fault_of_residuals(p[tension], p[tension_residual], p[cohesion], p[cohesion_residual]);
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[stiffness_normal];
    *shear = p[stiffness_shear];
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "power",
    "Coulomb slip with power-law creep",
    "1.0",
    properties,
    property_count,
    history,
    history_count,
    coulomb::state_names,
    initialise,
    run,
    check,
    max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
