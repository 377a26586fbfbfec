// Built for an interface that this program does not support.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("version-99");
    model.interface_version = 99;
    return &model;
}
