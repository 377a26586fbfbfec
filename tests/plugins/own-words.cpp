// Coulomb slip whose words say nothing: what they mean is stated by roles.
#include "tests/plugins/plugin.hpp"

namespace {

enum { stiff, soft, phi, c, friction, count };

constexpr kaya_jproperty properties[count] = {
    {"p1", "", "stress/length", "normal stiffness", NAN, 0, INFINITY, 0, KAYA_JROLE_STIFFNESS_NORMAL},
    {"p2", "", "stress/length", "shear stiffness", NAN, 0, INFINITY, 0, KAYA_JROLE_STIFFNESS_SHEAR},
    {"phi", "", "angle", "angle of friction", NAN, 0, 89, 0, KAYA_JROLE_FRICTION},
    {"c", "", "stress", "cohesion", 0, 0, INFINITY, 0, KAYA_JROLE_COHESION},
    {"friction", "", "angle", "a number without meaning", 45, 0, 89, 0, KAYA_JROLE_NONE},
};

ptrdiff_t set_stiffness(kaya_jbatch* b) {
    for (size_t i = 0; i < b->n; ++i) {
        b->normal_stiffness[i] = b->properties[stiff];
        b->shear_stiffness[i] = b->properties[soft];
    }
    return -1;
}

ptrdiff_t run(kaya_jbatch* b) {
    const double* p = b->properties;
    const double tangent = std::tan(p[phi] * 3.14159265358979323846 / 180);
    for (size_t i = 0; i < b->n; ++i) {
        double& normal = b->normal_force[i];
        normal -= p[stiff] * b->area[i] * b->normal_disp_inc[i];
        double size = 0;
        for (int k = 0; k < 3; ++k) {
            b->shear_force[k][i] -= p[soft] * b->area[i] * b->shear_disp_inc[k][i];
            size += b->shear_force[k][i] * b->shear_force[k][i];
        }
        size = std::sqrt(size);
        if (normal < 0) normal = 0;
        const double limit = normal > 0 ? p[c] * b->area[i] + normal * tangent : 0;
        if (size <= limit) continue;
        for (int k = 0; k < 3; ++k) b->shear_force[k][i] *= limit / size;
        b->state[i] |= 1;
    }
    return -1;
}

void max_stiffness(const double* values, double* normal, double* shear) {
    *normal = values[stiff], *shear = values[soft];
}

constexpr kaya_jmodel model = {KAYA_JMODEL_INTERFACE,
                               sizeof(kaya_jmodel),
                               "own-words",
                               "for tests",
                               "1.0",
                               properties,
                               count,
                               nullptr,
                               0,
                               "slip",
                               set_stiffness,
                               run,
                               nullptr,
                               max_stiffness};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &model; }
