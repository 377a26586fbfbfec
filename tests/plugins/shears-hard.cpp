// Correct normal stiffness, but ten times the reported shear stiffness.
#include "tests/plugins/plugin.hpp"

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    plugin::push(batch);
    for (size_t i = 0; i < batch->n; ++i)
        batch->shear_force[0][i] -= 10 * batch->properties[0] * batch->area[i] * batch->shear_disp_inc[0][i];
    return -1;
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("shears-hard");
    model.run = run;
    return &model;
}
