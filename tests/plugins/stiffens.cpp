// Ten times the reported normal stiffness under load, but not at first closure.
#include "tests/plugins/plugin.hpp"

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) {
        const double stress = batch->normal_force[i] / batch->area[i];
        const double stiffness = batch->properties[0] * (stress < 1e-5 * batch->properties[0] ? 1 : 10);
        batch->normal_force[i] -= stiffness * batch->area[i] * batch->normal_disp_inc[i];
    }
    return -1;
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("stiffens");
    model.run = run;
    return &model;
}
