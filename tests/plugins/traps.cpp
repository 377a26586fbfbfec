// Enables the trap for division by 0, and does not restore it.
#include "tests/plugins/plugin.hpp"

#include <cfenv>

namespace {

ptrdiff_t run(kaya_jbatch* batch) {
    feenableexcept(FE_DIVBYZERO | FE_INVALID);
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("traps");
    model.run = run;
    return &model;
}
