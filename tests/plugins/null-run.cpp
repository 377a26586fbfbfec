// Has no function run.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("null-run");
    model.run = nullptr;
    return &model;
}
