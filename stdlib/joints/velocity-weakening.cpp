// Joint model `velocity-weakening`: Coulomb slip whose friction falls with the speed of sliding.
// docs/joint-models/velocity-weakening.md has the equations; (n) below are their numbers.
#include "stdlib/joints/coulomb.hpp"

#include <iterator>

namespace {

using namespace kaya::joints;
using coulomb::tan_degrees;

enum Property {
    stiffness_normal,
    stiffness_shear,
    friction_static,
    friction_dynamic,
    exponent,
    reference_velocity,
    use_plastic,
    cohesion,
    tension,
    dilation,
    dilation_zero,
    cohesion_residual,
    tension_residual,
    property_count
};

constexpr kaya_jproperty properties[] = {
    coulomb::stiffness_normal_row,
    coulomb::stiffness_shear_row,
    {"friction-static", "friction jfriction fric", "angle", "angle of friction at rest", 0, 0, 90, 0},
    {"friction-dynamic", "", "angle", "angle of friction of fast sliding; not given: that at rest", NAN, 0, 90, 1},
    {"exponent", "", "-", "power of the speed in the fall of friction", 1, 0.1, 10, 0},
    {"reference-velocity", "", "length/time", "speed at which half of the fall is done", NAN, 0, INFINITY, 0},
    {"use-plastic", "", "-", "1: speed counts only while the joint slips, a joint that sticks has its friction at rest", 0, 0, 1, 0},
    coulomb::cohesion_row,
    coulomb::tension_row,
    coulomb::dilation_row,
    coulomb::dilation_zero_row,
    coulomb::cohesion_residual_row,
    coulomb::tension_residual_row,
};
static_assert(std::size(properties) == property_count);

enum History { gap, slip, velocity, friction_current, history_count };

constexpr kaya_jhistory history[] = {
    coulomb::gap_row,
    coulomb::slip_row,
    {"velocity", "length/time", "speed of the two sides along the joint in the last step"},
    {"friction-current", "angle", "angle of friction in the last step"},
};
static_assert(std::size(history) == history_count);

ptrdiff_t initialise(kaya_jbatch* batch) {
    coulomb::initialise(*batch, gap, batch->properties[stiffness_normal], batch->properties[stiffness_shear]);
    for (std::size_t i = 0; i < batch->n; ++i)
        if (batch->history[friction_current][i] == 0)
            batch->history[friction_current][i] = batch->properties[friction_static];
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const double kn = p[stiffness_normal], ks = p[stiffness_shear];
    const double at_rest = tan_degrees(p[friction_static]);
    const double fast = std::isnan(p[friction_dynamic]) ? at_rest : tan_degrees(p[friction_dynamic]);
    const double dilatancy = tan_degrees(p[dilation]);
    const double last_dilation = p[dilation_zero] > 0 ? p[dilation_zero] : INFINITY;
    const double per_time = batch->time_step > 0 ? 1 / batch->time_step : 0;
    const double per_velocity = 1 / p[reference_velocity], power = p[exponent];
    const bool plastic = p[use_plastic] != 0;

    const coulomb::Columns columns(*batch, gap, slip);
    double* speeds = batch->history[velocity];
    double* angle = batch->history[friction_current];
    for (std::size_t i = 0; i < batch->n; ++i) {
        const bool failed = columns.states[i] != 0;
        const double moved = std::sqrt(columns.shear_x[i] * columns.shear_x[i] + columns.shear_y[i] * columns.shear_y[i] +
                                       columns.shear_z[i] * columns.shear_z[i]);
        const bool sticks = plastic && (columns.states[i] & coulomb::slip_now) == 0;
        const double speed = moved * per_time, counted = sticks ? 0 : speed;
        const double tangent = fast + (at_rest - fast) / (1 + std::pow(counted * per_velocity, power)); // (1)
        const coulomb::Line strength{(failed ? p[cohesion_residual] : p[cohesion]) * columns.area[i], tangent};
        coulomb::step(
            columns, i, kn, ks,
            {failed ? p[tension_residual] : p[tension], p[tension_residual], dilatancy, last_dilation}, strength);
        speeds[i] = speed;
        angle[i] = coulomb::degrees_of_tangent(tangent);
    }
    return -1;
}

const char* check(const double* p) {
    if (const char* fault = coulomb::fault_of_stiffness(p[stiffness_normal], p[stiffness_shear])) return fault;
    if (!(p[reference_velocity] > 0))
        return "reference-velocity is 0: give the speed at which half of the friction's fall is done";
    if (p[friction_dynamic] > p[friction_static])
        return "friction-dynamic is above friction-static: this joint weakens with speed, give a friction-static of at "
               "least that";
    return coulomb::fault_of_residuals(p[tension], p[tension_residual], p[cohesion], p[cohesion_residual]);
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[stiffness_normal];
    *shear = p[stiffness_shear];
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "velocity-weakening",
    "Coulomb slip with friction that falls with speed",
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
