// Does not return from its 50th step.
#include "tests/plugins/plugin.hpp"

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    while (batch->history[0][0] > 50) {
        volatile double& again = batch->history[0][0];
        again = 51;
    }
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("loops-in-run");
    model.run = run;
    return &model;
}
