// Writes to the properties, which all its batches share, after some steps.
#include "tests/plugins/plugin.hpp"

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    if (batch->history[0][0] > 100) const_cast<double*>(batch->properties)[0] *= 2;
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("writes-properties");
    model.run = run;
    return &model;
}
