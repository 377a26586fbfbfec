// Writes to a read-only column.
#include "tests/plugins/plugin.hpp"

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) const_cast<double*>(batch->area)[i] *= 0.5;
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("writes-area");
    model.run = run;
    return &model;
}
