// A library of interface 3: the bytes that are the role of a property from version 4 on were padding, with any content.
#include "tests/plugins/plugin.hpp"

namespace {

constexpr kaya_jproperty properties[] = {
    {"friction", "", "angle", "not used", 30, 0, 89, 0, 0xdeadbeef},
    {"stiffness", "k", "stress/length", "stiffness of both springs", 1, 0, INFINITY, 0, 1},
};

ptrdiff_t set_stiffness(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) batch->normal_stiffness[i] = batch->shear_stiffness[i] = batch->properties[1];
    return -1;
}

void report_stiffness(const double* values, double* normal, double* shear) { *normal = *shear = values[1]; }

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = [] {
        kaya_jmodel made = plugin::working("interface-3");
        made.interface_version = 3;
        made.properties = properties;
        made.property_count = 2;
        made.initialise = set_stiffness;
        made.run = set_stiffness;
        made.max_stiffness = report_stiffness;
        return made;
    }();
    return &model;
}
