// A property without a name.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("nameless-property");
    static constexpr kaya_jproperty nameless[] = {{nullptr, "", "", "", 1, 0, 2, 0}};
    model.properties = nameless;
    return &model;
}
