// Joint model `mohr`: Coulomb slip with cohesion, tension cut-off, dilation and residual strength.
// docs/joint-models/mohr.md has the equations.
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
    property_count
};

constexpr kaya_jproperty properties[] = {
    coulomb::stiffness_normal_row,  coulomb::stiffness_shear_row,  coulomb::friction_row,
    coulomb::cohesion_row,          coulomb::tension_row,          coulomb::dilation_row,
    coulomb::dilation_zero_row,     coulomb::friction_residual_row, coulomb::cohesion_residual_row,
    coulomb::tension_residual_row,
};
static_assert(std::size(properties) == property_count);

enum History { gap, slip, history_count };

constexpr kaya_jhistory history[] = {coulomb::gap_row, coulomb::slip_row};
static_assert(std::size(history) == history_count);

ptrdiff_t initialise(kaya_jbatch* batch) {
    coulomb::initialise(*batch, gap, batch->properties[stiffness_normal], batch->properties[stiffness_shear]);
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const double kn = p[stiffness_normal], ks = p[stiffness_shear];
    const double peak_tension = p[tension], residual_tension = p[tension_residual];
    const double peak_cohesion = p[cohesion], residual_cohesion = p[cohesion_residual];
    const double peak_friction = tan_degrees(p[friction]);
    const double residual_friction =
        std::isnan(p[friction_residual]) ? peak_friction : tan_degrees(p[friction_residual]);
    const double dilatancy = tan_degrees(p[dilation]);
    const double last_dilation = p[dilation_zero] > 0 ? p[dilation_zero] : INFINITY;

    const coulomb::Columns columns(*batch, gap, slip);
    const std::size_t n = batch->n;
#pragma GCC ivdep
    for (std::size_t i = 0; i < n; ++i) {
        const bool failed = columns.states[i] != 0;
        const coulomb::Line strength{(failed ? residual_cohesion : peak_cohesion) * columns.area[i],
                                     failed ? residual_friction : peak_friction};
        coulomb::step(columns, i, kn, ks,
                      {failed ? residual_tension : peak_tension, residual_tension, dilatancy, last_dilation}, strength);
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
    "mohr",
    "Coulomb slip with tension cut-off, dilation and residual strength",
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
