// A property whose limits are not numbers.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("nan-limits");
    static constexpr kaya_jproperty unlimited[] = {{"stiffness", "", "", "", 1, NAN, 2, 0}};
    model.properties = unlimited;
    return &model;
}
