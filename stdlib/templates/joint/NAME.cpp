// @NAME@: springs in both directions and Coulomb's friction. Change it into what you need. kaya/jmodel.h is the manual: the columns, their
// signs, and which members are optional.
#include "kaya/jmodel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace {

// run() gets the values in the order of the table; the enum names them.
enum { stiffness_normal, stiffness_shear, friction, property_count };

constexpr kaya_jproperty properties[] = {
    // name, other words, unit, help, initial value (NAN: must be given), minimum, maximum, may be left out
    {"stiffness-normal", "jkn kn", "stress/length", "normal stress per closure", NAN, 0, INFINITY, 0},
    {"stiffness-shear", "jks ks", "stress/length", "shear stress per shear displacement", NAN, 0, INFINITY, 0},
    {"friction", "jfriction fric", "angle", "angle of friction", 0, 0, 89, 0},
};
static_assert(std::size(properties) == property_count);

// History of each sub-contact: kept from cycle to cycle, initially 0, and saved.
enum { slip, history_count };

constexpr kaya_jhistory history[] = {{"slip", "length", "shear displacement beyond the limit, added up"}};
static_assert(std::size(history) == history_count);

// Bit 0, bit 1, ... of the column of states.
constexpr const char* state_names = "slip-now slip-past";
constexpr uint32_t slip_now = 1, slip_past = 2;

ptrdiff_t initialise(kaya_jbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) {
        batch->normal_stiffness[i] = batch->properties[stiffness_normal];
        batch->shear_stiffness[i] = batch->properties[stiffness_shear];
    }
    return -1; // all rows are well
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const double kn = p[stiffness_normal], ks = p[stiffness_shear];
    const double tangent = std::tan(p[friction] * 3.14159265358979323846 / 180);
    double *x = batch->shear_force[0], *y = batch->shear_force[1], *z = batch->shear_force[2];
#pragma GCC ivdep
    for (size_t i = 0; i < batch->n; ++i) {
        const double area = batch->area[i];
        // Compression is positive, opening is positive; no tension is carried.
        const double normal = std::max(0.0, batch->normal_force[i] - kn * area * batch->normal_disp_inc[i]);
        // Shear forces oppose shear displacement.
        const double trial_x = x[i] - ks * area * batch->shear_disp_inc[0][i];
        const double trial_y = y[i] - ks * area * batch->shear_disp_inc[1][i];
        const double trial_z = z[i] - ks * area * batch->shear_disp_inc[2][i];
        const double trial = std::sqrt(trial_x * trial_x + trial_y * trial_y + trial_z * trial_z);
        const double limit = std::min(trial, normal * tangent);
        const double scale = limit / std::max(trial, std::numeric_limits<double>::min());
        const double slipped = area > 0 ? (trial - limit) / (ks * area) : 0;
        // Slip takes up the mean of the forces before and after it; this closes the account of energy.
        const double before = x[i] * trial_x + y[i] * trial_y + z[i] * trial_z, after = limit * trial;

        batch->frictional_work[i] +=
            0.5 * (before + after) / std::max(trial, std::numeric_limits<double>::min()) * slipped;
        batch->normal_force[i] = normal;
        x[i] = trial_x * scale;
        y[i] = trial_y * scale;
        z[i] = trial_z * scale;
        batch->history[slip][i] += slipped;
        batch->state[i] = (batch->state[i] ? slip_past : 0) | (trial > limit ? slip_now : 0);
    }
    return -1;
}

// A sentence when the values cannot work together.
const char* check(const double* p) {
    if (!(p[stiffness_normal] > 0)) return "stiffness-normal (jkn) is 0: give the joint a normal stiffness";
    if (!(p[stiffness_shear] > 0)) return "stiffness-shear (jks) is 0: give the joint a shear stiffness";
    return nullptr;
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[stiffness_normal];
    *shear = p[stiffness_shear];
}

constexpr kaya_jmodel model = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "@NAME@",
    "Springs and Coulomb's friction",
    "0.1",
    properties,
    property_count,
    history,
    history_count,
    state_names,
    initialise,
    run,
    check,
    max_stiffness,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &model; }
