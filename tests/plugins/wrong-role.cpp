// The role of its property is a number that no version knows.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jproperty property = plugin::properties[0];
    property.role = 99;
    static kaya_jmodel model = plugin::working("wrong-role");
    model.properties = &property;
    return &model;
}
