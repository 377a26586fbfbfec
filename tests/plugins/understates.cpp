// Reports 1/100 of its stiffness, and in shear is stiffer in loading than in unloading, which creates energy.
#include "tests/plugins/plugin.hpp"

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) {
        batch->normal_force[i] -= 1000 * batch->area[i] * batch->normal_disp_inc[i];
        const double stiffness = batch->shear_disp_inc[0][i] > 0 ? 200 : 100;
        batch->shear_force[0][i] -= stiffness * batch->area[i] * batch->shear_disp_inc[0][i];
    }
    return -1;
}

ptrdiff_t initialise(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) batch->normal_stiffness[i] = batch->shear_stiffness[i] = 10;
    return -1;
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = [] {
        auto made = plugin::working("understates");
        made.initialise = initialise;
        made.run = run;
        return made;
    }();
    return &model;
}
