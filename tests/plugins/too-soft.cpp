// Reports 1/100 of its stiffness.
#include "tests/plugins/plugin.hpp"

namespace {

ptrdiff_t initialise(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i)
        batch->normal_stiffness[i] = batch->shear_stiffness[i] = 0.01 * batch->properties[0];
    return -1;
}

void stiffness(const double* values, double* normal, double* shear) { *normal = *shear = 0.01 * values[0]; }

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("too-soft");
    model.initialise = initialise;
    model.max_stiffness = stiffness;
    return &model;
}
