// Has the right version and another layout.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("other-size");
    model.size = 8;
    return &model;
}
