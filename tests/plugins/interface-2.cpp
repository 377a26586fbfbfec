// Built for interface version 2, with its header: it loads and runs.
#include "tests/plugins/interface-2.h"

#include <cmath>

namespace {

constexpr kaya_jproperty properties[] = {
    {"stiffness", "k", "stress/length", "stiffness of both springs", 1, 0, INFINITY, 0}};
constexpr kaya_jhistory history[] = {{"steps", "-", "steps run"}};

ptrdiff_t initialise(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) batch->normal_stiffness[i] = batch->shear_stiffness[i] = batch->properties[0];
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) {
        batch->normal_force[i] -= batch->properties[0] * batch->area[i] * batch->normal_disp_inc[i];
        batch->history[0][i] += 1;
    }
    return -1;
}

void max_stiffness(const double* values, double* normal, double* shear) { *normal = *shear = values[0]; }

constexpr kaya_jmodel model = {KAYA_JMODEL_INTERFACE,
                               sizeof(kaya_jmodel),
                               "interface-2",
                               "for tests",
                               "1.0",
                               properties,
                               1,
                               history,
                               1,
                               "pushed",
                               initialise,
                               run,
                               nullptr,
                               max_stiffness};
static_assert(KAYA_JMODEL_INTERFACE == 2 && sizeof(kaya_jmodel) == 112);

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &model; }
