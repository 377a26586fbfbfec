// Joint model `elastic`: two linear springs. It never slips and never opens: it carries tension.
#include "kaya/jmodel.h"

#include <cmath>
#include <iterator>

namespace {

enum Property { stiffness_normal, stiffness_shear, property_count };

constexpr kaya_jproperty properties[] = {
    {"stiffness-normal", "jkn kn", "stress/length", "normal stress per closure", NAN, 0, INFINITY, 0},
    {"stiffness-shear", "jks ks", "stress/length", "shear stress per shear displacement", NAN, 0, INFINITY, 0},
};
static_assert(std::size(properties) == property_count);

ptrdiff_t initialise(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) {
        batch->normal_stiffness[i] = batch->properties[stiffness_normal];
        batch->shear_stiffness[i] = batch->properties[stiffness_shear];
    }
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double kn = batch->properties[stiffness_normal], ks = batch->properties[stiffness_shear];
    const double* __restrict area = batch->area;
    const double* __restrict opening = batch->normal_disp_inc;
    double* __restrict normal_force = batch->normal_force;
    for (size_t i = 0; i < batch->n; ++i) normal_force[i] -= kn * area[i] * opening[i];
    for (int k = 0; k < 3; ++k) {
        const double* __restrict slip = batch->shear_disp_inc[k];
        double* __restrict shear_force = batch->shear_force[k];
        for (size_t i = 0; i < batch->n; ++i) shear_force[i] -= ks * area[i] * slip[i];
    }
    return -1;
}

const char* check(const double* values) {
    return values[stiffness_normal] > 0 ? nullptr : "stiffness-normal (jkn) is 0: give the joint a normal stiffness";
}

void max_stiffness(const double* values, double* normal, double* shear) {
    *normal = values[stiffness_normal];
    *shear = values[stiffness_shear];
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "elastic",
    "Linear elastic joint",
    "1.0",
    properties,
    property_count,
    nullptr,
    0,
    "",
    initialise,
    run,
    check,
    max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
