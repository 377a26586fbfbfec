// The file has one name, the model in it another.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("other-name");
    model.name = "something-else";
    return &model;
}
