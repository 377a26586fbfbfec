// Has more fields than allowed.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static const kaya_jfield fields[] = {{"one", "", "", 0}};
    static kaya_jmodel model = plugin::working("too-many-fields");
    model.fields = fields;
    model.field_count = 100;
    return &model;
}
