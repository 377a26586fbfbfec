// Common parts of the faulty plugins: a working model, to be changed in one place.
#pragma once

#include "kaya/jmodel.h"

#include <cmath>

namespace plugin {

inline constexpr kaya_jproperty properties[] = {
    {"stiffness", "k", "stress/length", "stiffness of both springs", 1, 0, INFINITY, 0},
};

inline constexpr kaya_jhistory history[] = {{"steps", "-", "steps run"}};

inline ptrdiff_t set_stiffness(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) batch->normal_stiffness[i] = batch->shear_stiffness[i] = batch->properties[0];
    return -1;
}

inline ptrdiff_t push(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) {
        batch->normal_force[i] -= batch->properties[0] * batch->area[i] * batch->normal_disp_inc[i];
        batch->history[0][i] += 1;
    }
    return -1;
}

inline void report_stiffness(const double* values, double* normal, double* shear) { *normal = *shear = values[0]; }

inline constexpr kaya_jmodel working(const char* name) {
    return {KAYA_JMODEL_INTERFACE,
            sizeof(kaya_jmodel),
            name,
            "for tests",
            "1.0",
            properties,
            1,
            history,
            1,
            "pushed",
            set_stiffness,
            push,
            nullptr,
            report_stiffness};
}

} // namespace plugin
