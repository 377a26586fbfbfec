// A field without a name.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static const kaya_jfield fields[] = {{nullptr, "", "", 0}};
    static kaya_jmodel model = plugin::working("nameless-field");
    model.fields = fields;
    model.field_count = 1;
    return &model;
}
