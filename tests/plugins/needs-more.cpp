// Calls an undefined function.
#include "tests/plugins/plugin.hpp"

extern "C" int function_that_nobody_has();

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("needs-more");
    model.size += static_cast<uint32_t>(function_that_nobody_has());
    return &model;
}
