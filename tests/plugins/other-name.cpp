// The model has another name than its file.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("other-name");
    model.name = "something-else";
    return &model;
}
