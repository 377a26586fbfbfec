// A property that starts outside its limits.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("initial-outside");
    static constexpr kaya_jproperty outside[] = {{"stiffness", "", "", "", 5, 0, 2, 0}};
    model.properties = outside;
    return &model;
}
