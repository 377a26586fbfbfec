// Calls exit() when its 50th step is run.
#include "tests/plugins/plugin.hpp"

#include <cstdlib>

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    if (batch->history[0][0] > 50) std::exit(0);
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("exits-in-run");
    model.run = run;
    return &model;
}
