// Has no function initialise.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("null-initialise");
    model.initialise = nullptr;
    return &model;
}
