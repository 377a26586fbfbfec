// Two properties share a keyword.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("two-of-a-name");
    static constexpr kaya_jproperty twins[] = {{"stiffness", "k", "", "", 1, 0, 2, 0},
                                               {"key", "k", "", "", 1, 0, 2, 0}};
    model.properties = twins;
    model.property_count = 2;
    return &model;
}
