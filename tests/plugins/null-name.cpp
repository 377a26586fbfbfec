// Has no name.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("null-name");
    model.name = nullptr;
    return &model;
}
