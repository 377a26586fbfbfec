// Has a stiffness of 0, from which no time step can be computed.
#include "tests/plugins/plugin.hpp"

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("no-stiffness");
    model.max_stiffness = [](const double*, double* normal, double* shear) { *normal = *shear = 0; };
    return &model;
}
