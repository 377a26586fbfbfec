// Declares an impossible number of history variables.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("negative-count");
    model.history_count = static_cast<size_t>(-1);
    return &model;
}
