// Has more properties than allowed.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("too-many-properties");
    model.property_count = 1000000;
    return &model;
}
