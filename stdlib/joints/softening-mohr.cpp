// Joint model `softening-mohr`: Coulomb slip whose strength falls with slip, and whose friction heals at rest.
// docs/joint-models/softening-mohr.md has the equations; (n) below are their numbers.
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
    slip_distance,
    exponent,
    healing,
    healing_time,
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
    {"dc", "slip-distance", "length", "slip over which strength falls to its residual value", NAN, 0, INFINITY, 0},
    {"alpha", "", "-", "exponent of the fall; 1: straight", 1, 0.1, 10, 0},
    {"healing", "", "-", "1: friction is back at its peak when the joint has come to rest", 1, 0, 1, 0},
    {"healing-time", "", "time", "rest that healing needs", 0, 0, INFINITY, 0},
};
static_assert(std::size(properties) == property_count);

enum History { gap, slip, weakening, rest, friction_current, history_count };

constexpr kaya_jhistory history[] = {
    coulomb::gap_row,
    coulomb::slip_row,
    {"weakening", "length", "slip since the joint last healed"},
    {"rest", "time", "time since the last slip"},
    {"friction-current", "angle", "angle of friction at this slip"},
};
static_assert(std::size(history) == history_count);

ptrdiff_t initialise(kaya_jbatch* batch) {
    coulomb::initialise(*batch, gap, batch->properties[stiffness_normal], batch->properties[stiffness_shear]);
    for (std::size_t i = 0; i < batch->n; ++i)
        if (batch->history[friction_current][i] == 0)
            batch->history[friction_current][i] = batch->properties[friction];
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const double kn = p[stiffness_normal], ks = p[stiffness_shear];
    const double peak = tan_degrees(p[friction]);
    const double residual = std::isnan(p[friction_residual]) ? peak : tan_degrees(p[friction_residual]);
    const double dilatancy = tan_degrees(p[dilation]);
    const double last_dilation = p[dilation_zero] > 0 ? p[dilation_zero] : INFINITY;
    const double per_distance = 1 / p[slip_distance], alpha = p[exponent];
    const double rest_needed = p[healing_time];
    const bool heals = p[healing] != 0;
    /// What is left between peak and residual strength after a slip (1).
    const auto left = [=](double slipped) {
        const double part = 1 - slipped * per_distance;
        return part > 0 ? std::pow(part, alpha) : 0;
    };

    const coulomb::Columns columns(*batch, gap, slip);
    double* weak = batch->history[weakening];
    double* rests = batch->history[rest];
    double* angle = batch->history[friction_current];
    for (std::size_t i = 0; i < batch->n; ++i) {
        // A bond that broke in tension is gone; one that slides is worn, and neither heals.
        const bool broken = (columns.states[i] & (coulomb::tension_now | coulomb::tension_past)) != 0;
        const double bonded = broken ? 0 : left(columns.slips[i]);
        const double tangent = residual + (peak - residual) * left(weak[i]); // (2)
        const double cohesive = p[cohesion_residual] + (p[cohesion] - p[cohesion_residual]) * bonded;
        const double tensile = p[tension_residual] + (p[tension] - p[tension_residual]) * bonded;
        const coulomb::Line strength{cohesive * columns.area[i], tangent};
        const auto outcome = coulomb::step(columns, i, kn, ks,
                                           {tensile, p[tension_residual], dilatancy, last_dilation}, strength);
        rests[i] = outcome.slips ? 0 : rests[i] + batch->time_step;
        const bool healed = heals && !outcome.slips && rests[i] >= rest_needed;
        weak[i] = healed ? 0 : weak[i] + outcome.slipped;
        angle[i] = coulomb::degrees_of_tangent(residual + (peak - residual) * left(weak[i]));
    }
    return -1;
}

const char* check(const double* p) {
    if (const char* fault = coulomb::fault_of_stiffness(p[stiffness_normal], p[stiffness_shear])) return fault;
    if (!(p[slip_distance] > 0)) return "dc is 0: give the slip over which the strength falls, or use jmodel mohr";
    if (p[friction_residual] > p[friction])
        return "friction-residual is above friction: this joint only weakens with slip, give a friction of at least "
               "that";
    return coulomb::fault_of_residuals(p[tension], p[tension_residual], p[cohesion], p[cohesion_residual]);
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[stiffness_normal];
    *shear = p[stiffness_shear];
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "softening-mohr",
    "Coulomb slip that weakens with slip and heals at rest",
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
