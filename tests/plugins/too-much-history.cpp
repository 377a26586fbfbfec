// Has more history variables than allowed.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("too-much-history");
    model.history_count = KAYA_JMODEL_MAX_HISTORY + 1;
    return &model;
}
