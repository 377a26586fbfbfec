// Claims the name of a model that ships.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("twin");
    model.name = "mohr";
    return &model;
}
