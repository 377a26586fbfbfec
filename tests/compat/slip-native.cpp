// The twin of v9/jmodelslip9.cpp and slip-lua.lua against the native interface.
#include "kaya/jmodel.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace {

enum { kn, ks, friction, friction_residual, cohesion, tension, dilation, property_count };

constexpr kaya_jproperty properties[] = {
    {"stiffness-normal", "kn", "stress/length", "normal stress per closure", NAN, 0, INFINITY, 0},
    {"stiffness-shear", "ks", "stress/length", "shear stress per shear displacement", NAN, 0, INFINITY, 0},
    {"friction", "", "angle", "", 0, 0, 90, 0},
    {"friction-residual", "", "angle", "", 0, 0, 90, 0},
    {"cohesion", "", "stress", "", 0, 0, INFINITY, 0},
    {"tension", "", "stress", "", 0, 0, INFINITY, 0},
    {"dilation", "", "angle", "", 0, 0, 90, 0},
};
static_assert(std::size(properties) == property_count);

constexpr uint32_t slip_now = 1, tension_now = 2, slip_past = 4, tension_past = 8;

double tangent(double degrees) { return std::tan(degrees * (3.14159265358979323846 / 180)); }

ptrdiff_t initialise(kaya_jbatch* b) {
    for (size_t i = 0; i < b->n; ++i) {
        b->normal_stiffness[i] = b->properties[kn];
        b->shear_stiffness[i] = b->properties[ks];
    }
    return -1;
}

ptrdiff_t run(kaya_jbatch* b) {
    const double* p = b->properties;
    const double peak = tangent(p[friction]), residual = tangent(p[friction_residual]), lift = tangent(p[dilation]);
    for (size_t i = 0; i < b->n; ++i) {
        uint32_t& state = b->state[i];
        if (state & slip_now) state |= slip_past;
        if (state & tension_now) state |= tension_past;
        state &= ~(slip_now | tension_now);
        const bool failed = (state & (slip_past | tension_past)) != 0;
        const double area = b->area[i];
        double& normal = b->normal_force[i];
        normal += -p[kn] * area * b->normal_disp_inc[i];
        if (normal <= (failed ? 0.0 : -p[tension] * area)) {
            normal = 0;
            for (auto* force : b->shear_force) force[i] = 0;
            state |= tension_now;
            continue;
        }
        double square = 0;
        for (int x = 0; x < 3; ++x) {
            b->shear_force[x][i] += b->shear_disp_inc[x][i] * (-p[ks] * area);
            square += b->shear_force[x][i] * b->shear_force[x][i];
        }
        const double shear = std::sqrt(square);
        const double most = std::max(0.0, (failed ? 0.0 : p[cohesion] * area) + normal * (failed ? residual : peak));
        if (shear <= most) continue;
        const double slip = (shear - most) / (p[ks] * area);
        for (auto* force : b->shear_force) force[i] *= most / shear;
        normal += p[kn] * area * lift * slip;
        state |= slip_now;
        b->frictional_work[i] += most * slip;
    }
    return -1;
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[kn];
    *shear = p[ks];
}

constexpr kaya_jmodel model = {
    KAYA_JMODEL_INTERFACE, sizeof(kaya_jmodel), "slip-native", "Coulomb slip, native", "1.0",
    properties, property_count, nullptr, 0, "slip-n tension-n slip-p tension-p",
    initialise, run, nullptr, max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &model; }
