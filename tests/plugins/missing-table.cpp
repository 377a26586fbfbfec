// Declares properties without a table.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("missing-table");
    model.properties = nullptr;
    return &model;
}
