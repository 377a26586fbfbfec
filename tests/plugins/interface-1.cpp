// Built for an interface that is too old.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("interface-1");
    model.interface_version = 1;
    return &model;
}
