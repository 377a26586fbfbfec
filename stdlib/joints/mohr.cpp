// Joint model `mohr`: Coulomb slip with cohesion, tension cut-off, dilation and residual strength.
// docs/joint-models/mohr.md has the equations; (n) below are their numbers.
#include "kaya/jmodel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace {

enum Property {
    stiffness_normal,
    stiffness_shear,
    friction,
    cohesion,
    tension,
    dilation,
    dilation_zero,
    friction_residual,
    cohesion_residual,
    tension_residual,
    property_count
};

// Aliases are whole words: any leading part of one, as in jfric, is understood too.
constexpr kaya_jproperty properties[] = {
    {"stiffness-normal", "jkn kn", "stress/length", "normal stress per closure", NAN, 0, INFINITY, 0},
    {"stiffness-shear", "jks ks", "stress/length", "shear stress per shear displacement", NAN, 0, INFINITY,
     0},
    {"friction", "jfriction fric", "angle", "angle of friction before failure", 0, 0, 90, 0},
    {"cohesion", "jcohesion coh", "stress", "shear strength at zero normal stress before failure", 0, 0, INFINITY,
     0},
    {"tension", "jtension ten", "stress", "tensile strength before failure", 0, 0, INFINITY, 0},
    {"dilation", "jdilation dil", "angle", "angle of dilation while it slips", 0, 0, 89, 0},
    {"dilation-zero", "zdilation", "length", "slip at which dilation ends; 0: it does not end", 0, 0, INFINITY, 0},
    {"friction-residual", "jrfriction", "angle", "angle of friction after failure; not given: that before", NAN,
     0, 90, 1},
    {"cohesion-residual", "jrcohesion", "stress", "cohesion after failure", 0, 0, INFINITY, 0},
    {"tension-residual", "jrtension", "stress", "tensile strength after failure", 0, 0, INFINITY, 0},
};
static_assert(std::size(properties) == property_count);

enum History { gap, slip, history_count };

constexpr kaya_jhistory history[] = {
    {"gap", "length", "opening beyond the displacement at which the tensile limit was reached"},
    {"slip", "length", "plastic shear displacement, added up"},
};
static_assert(std::size(history) == history_count);

constexpr const char* state_names = "slip-now tension-now slip-past tension-past";
constexpr uint32_t slip_now = 1, tension_now = 2, tension_past = 8;
constexpr uint32_t now = slip_now | tension_now;
constexpr int from_now_to_past = 2; // places that a bit moves

double tan_degrees(double angle) { return std::tan(angle * (std::numbers::pi / 180)); }

ptrdiff_t initialise(kaya_jbatch* batch) {
    // A gap of this part of the size of the sub-contact is rounding of coordinates, and is none.
    constexpr double rounding = 1e-9;
    for (size_t i = 0; i < batch->n; ++i) {
        batch->normal_stiffness[i] = batch->properties[stiffness_normal];
        batch->shear_stiffness[i] = batch->properties[stiffness_shear];
        const double apart =
            batch->normal_disp[i] > rounding * std::sqrt(batch->area[i]) ? batch->normal_disp[i] : 0;
        const bool loaded = batch->normal_force[i] != 0;
        const double opened = batch->history[gap][i] > 0 ? batch->history[gap][i] : apart;
        batch->history[gap][i] = loaded ? 0 : opened;
        // What is apart has no bond that could pull it together.
        if (!loaded && opened > 0) batch->state[i] |= tension_past;
    }
    return -1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const double* p = batch->properties;
    const double kn = p[stiffness_normal], ks = p[stiffness_shear];
    const double peak_tension = p[tension], residual_tension = p[tension_residual];
    const double peak_cohesion = p[cohesion], residual_cohesion = p[cohesion_residual];
    const double peak_friction = tan_degrees(p[friction]);
    const double residual_friction =
        std::isnan(p[friction_residual]) ? peak_friction : tan_degrees(p[friction_residual]);
    const double dilatancy = tan_degrees(p[dilation]);
    const double last_dilation = p[dilation_zero] > 0 ? p[dilation_zero] : INFINITY;
    // A failed joint without tension parts: beyond a gap of 0 its sides touch no more.
    const double touching_gap = residual_tension > 0 ? INFINITY : 0;

    const double* areas = batch->area;
    const double* opening = batch->normal_disp_inc;
    const double* shear_x = batch->shear_disp_inc[0];
    const double* shear_y = batch->shear_disp_inc[1];
    const double* shear_z = batch->shear_disp_inc[2];
    double* normal_force = batch->normal_force;
    double* force_x = batch->shear_force[0];
    double* force_y = batch->shear_force[1];
    double* force_z = batch->shear_force[2];
    double* work = batch->frictional_work;
    double* gaps = batch->history[gap];
    double* slips = batch->history[slip];
    uint32_t* states = batch->state;

    // One straight line of arithmetic and selections, with minima and maxima instead of conditions
    // that depend on each other: so the compiler makes vector instructions of it.
#pragma GCC ivdep
    for (size_t i = 0; i < batch->n; ++i) {
        const double area = areas[i], old_gap = gaps[i], old_normal = normal_force[i];
        const double per_area = area > 0 ? 1 / area : 0;
        const uint32_t old_state = states[i];
        const bool failed = old_state != 0;

        // Normal: the spring acts on the displacement beyond the gap (1), up to the tensile limit (2).
        const double lowest = -residual_tension * area;
        const double held = old_gap > 0 ? lowest : old_normal;
        const double pulled = held - kn * area * (old_gap + opening[i]);
        const bool breaks = pulled < -(failed ? residual_tension : peak_tension) * area;
        const double stretched = breaks ? (lowest - pulled) * per_area / kn : 0;
        const double new_gap = area > 0 ? stretched : std::max(0.0, old_gap + opening[i]);
        const double elastic_normal = breaks ? lowest : pulled;
        const bool apart = new_gap > touching_gap;

        // Shear: elastic trial (3) against the limit (4).
        const double old_x = force_x[i], old_y = force_y[i], old_z = force_z[i];
        const double trial_x = old_x - ks * area * shear_x[i];
        const double trial_y = old_y - ks * area * shear_y[i];
        const double trial_z = old_z - ks * area * shear_z[i];
        const double trial = std::sqrt(trial_x * trial_x + trial_y * trial_y + trial_z * trial_z);
        const double bond = (failed ? residual_cohesion : peak_cohesion) * area;
        const double tangent = failed ? residual_friction : peak_friction;
        const double elastic_limit = std::max(0.0, bond + elastic_normal * tangent);
        const double excess = apart ? 0 : std::max(0.0, trial - elastic_limit);

        // Dilation raises the normal force and with it the limit: slip that brings trial and limit
        // together (5), as far as dilation lasts; the rest of the slip follows at the new limit (6).
        const double both = excess * per_area / (ks + kn * dilatancy * tangent);
        const double dilating = std::min(both, std::max(0.0, last_dilation - slips[i]));
        const double new_normal = elastic_normal + kn * area * dilatancy * dilating;
        const double strength = apart ? 0 : std::max(0.0, bond + new_normal * tangent);
        const double limit = std::min(trial, strength);
        const double slipped = (trial - limit) * per_area / ks;
        const double divisor = std::max(trial, std::numeric_limits<double>::min());
        const double scale = limit / divisor; // exactly 1 where it does not yield

        // Work taken up: mean force times slip, less what dilation lifts (7); and the energy of a
        // bond that breaks in tension.
        const double along_old = (old_x * trial_x + old_y * trial_y + old_z * trial_z) / divisor;
        const double sheared = 0.5 * (along_old + limit) * slipped;
        const double lifted = 0.5 * (old_normal + new_normal) * dilatancy * dilating;
        const double pull = std::min(0.0, old_normal);
        const double lost = 0.5 * std::max(0.0, pull * pull - lowest * lowest) * per_area / kn;
        work[i] += sheared - lifted + (breaks ? lost : 0);

        normal_force[i] = new_normal;
        force_x[i] = trial_x * scale;
        force_y[i] = trial_y * scale;
        force_z[i] = trial_z * scale;
        gaps[i] = new_gap;
        slips[i] += apart ? 0 : slipped;
        states[i] = (old_state & ~now) | ((old_state & now) << from_now_to_past) |
                    (excess > 0 ? slip_now : 0) | (breaks ? tension_now : 0);
    }
    return -1;
}

const char* check(const double* p) {
    if (!(p[stiffness_normal] > 0)) return "stiffness-normal (jkn) is 0: give the joint a normal stiffness";
    if (!(p[stiffness_shear] > 0)) return "stiffness-shear (jks) is 0: give the joint a shear stiffness";
    if (p[tension_residual] > p[tension])
        return "tension-residual is above tension: failure cannot make the joint stronger, give a tension of "
               "at least that";
    if (p[cohesion_residual] > p[cohesion])
        return "cohesion-residual is above cohesion: failure cannot make the joint stronger, give a cohesion "
               "of at least that";
    return nullptr;
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[stiffness_normal];
    *shear = p[stiffness_shear];
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "mohr",
    "Coulomb slip with tension cut-off, dilation and residual strength",
    "1.0",
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

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
