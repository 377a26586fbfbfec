// Processes one row too many.
#include "tests/plugins/plugin.hpp"

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    batch->shear_force[2][batch->n] = 0;
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("writes-behind");
    model.run = run;
    return &model;
}
