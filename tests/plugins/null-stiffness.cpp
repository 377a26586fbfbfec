// Has no function max_stiffness.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("null-stiffness");
    model.max_stiffness = nullptr;
    return &model;
}
