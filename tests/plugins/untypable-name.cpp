// Has a name that a deck cannot contain.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("untypable-name");
    model.name = "My Model";
    return &model;
}
