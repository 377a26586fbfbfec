// Has a name that no deck can hold.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("untypable-name");
    model.name = "My Model";
    return &model;
}
