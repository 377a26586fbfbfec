// Joint model `barton-bandis`: hyperbolic closure and mobilised roughness.
// docs/joint-models/barton-bandis.md has the equations; (n) below are their numbers.
#include "kaya/jmodel.h"
#include "stdlib/joints/barton-bandis/law.hpp"

#include <iterator>
#include <limits>

namespace {

using namespace kaya::joints;
using namespace kaya::joints::barton_bandis;

enum Property {
    stiffness_normal,
    stiffness_shear,
    friction_residual,
    jrco,
    jcso,
    sigmac,
    nj,
    rf,
    lo,
    ln,
    large,
    mpa,
    mm,
    delta_peak_lo,
    property_count
};

constexpr kaya_jproperty properties[] = {
    {"stiffness-normal", "jkn kn kni", "stress/length", "normal stiffness at first touch, k_ni", NAN, 0,
     INFINITY, 0},
    {"stiffness-shear", "jks ks kj", "stress/length", "shear stiffness at a normal stress of 1 MPa, K_j", NAN,
     0, INFINITY, 0},
    {"friction-residual", "resfriction jrfric", "angle", "residual angle of friction, phi_r", NAN, 0, 69, 0},
    {"jrco", "jrc", "-", "roughness coefficient of the laboratory sample, JRC_o", NAN, 0, INFINITY, 0},
    {"jcso", "jcs", "stress", "wall strength of the laboratory sample, JCS_o", NAN, 0, INFINITY, 0},
    {"sigmac", "", "stress", "uniaxial compressive strength of the rock", NAN, 0, INFINITY, 0},
    {"nj", "", "-", "exponent of normal stress in the shear stiffness", 0.8, 0, 4, 0},
    {"rf", "", "-", "failure ratio R_f of the unloading curve", 1, 0, 1, 0},
    {"lo", "", "length", "length of the laboratory sample; not given: 100 mm", NAN, 0, INFINITY, 1},
    {"ln", "", "length", "length of the joint in the field; not given: that of the sample", NAN, 0, INFINITY,
     1},
    {"large", "", "-", "1: jrco and jcso are those of the joint itself, without scaling", 0, 0, 1, 0},
    {"mpa", "", "stress", "1 MPa in the deck's unit of stress", 1, 0, INFINITY, 0},
    {"mm", "", "length", "1 mm in the deck's unit of length", 1e-3, 0, INFINITY, 0},
    {"delta-peak-lo", "", "-", "1: peak displacement with the sample's length in the root", 0, 0, 1, 0},
};
static_assert(std::size(properties) == property_count);

enum History { closure, mobilised, reversal_x, reversal_y, reversal_z, history_count };

constexpr kaya_jhistory history[] = {
    {"closure", "length", "closure of the joint; negative: how far it is open"},
    {"mobilised", "length", "shear displacement spent on the mobilised curve"},
    {"reversal-x", "stress", "shear stress at which the motion last turned back"},
    {"reversal-y", "stress", "shear stress at which the motion last turned back"},
    {"reversal-z", "stress", "shear stress at which the motion last turned back"},
};
static_assert(std::size(history) == history_count);

constexpr const char* state_names = "open slipping past-peak unloading";
constexpr uint32_t is_open = 1, is_slipping = 2, is_past_peak = 4, is_unloading = 8;

Given given(const double* p) {
    const double sample = std::isnan(p[lo]) ? 100 * p[mm] : p[lo];
    return {p[stiffness_normal],
            p[stiffness_shear],
            p[nj],
            p[rf],
            p[friction_residual],
            p[jrco],
            p[jcso],
            p[sigmac],
            sample,
            std::isnan(p[ln]) ? sample : p[ln],
            p[large] != 0,
            p[delta_peak_lo] != 0,
            p[mpa],
            p[mm]};
}

/// What the normal stress decides.
struct Strength {
    double stress, ruff, stiffness, peak;
};

[[gnu::always_inline]] inline Strength strength_at(const Law& law, double log_jcs, double closure_) {
    const double stress = normal_stress(law, closure_);
    const double log_stress = logarithm(std::max(stress, law.lowest_stress));
    const double ruff = roughness_angle(law, log_stress, log_jcs);
    // K_j sigma_n^n_j (2.28), sigma_n in MPa; 0 when open, where the logarithm was cut.
    const double power_of_stress =
        exponential(law.stiffness_exponent * (log_stress + logarithm(law.per_mpa)));
    return {stress, ruff, stress > 0 ? law.shear_stiffness * power_of_stress : 0,
            stress * tangent_of_degrees(law.residual_friction + ruff)};
}

/// The shear path of one step, in stresses: where it starts and how far it goes.
struct Path {
    double start_x, start_y, start_z;    ///< shear stress before
    double motion_x, motion_y, motion_z; ///< shear displacement increment
    double motion;                       ///< its length
    double swing;                        ///< stress since the last reversal
    double friction0, roughness0;        ///< mobilised before
    double friction1, roughness1;        ///< mobilised if all of the motion is spent on the curve
    double on_curve; ///< 1: the motion follows the mobilised curve; 0: unloading or reloading
};

/// The elastic trial and what of the motion is spent on the mobilised curve.
struct Trial {
    double x, y, z, size;
    double stiffness;
    double limit0, limit1; ///< mobilised strength before, and if all of the motion is spent
    double excess;
    double spent;    ///< displacement
    double dilation; ///< tangent of the mean dilation angle
};

[[gnu::always_inline]] inline Trial trial_at(const Law& law, const Strength& s, const Path& path) {
    constexpr double tiny = std::numeric_limits<double>::min();
    Trial t;
    t.limit0 =
        s.stress * tangent_of_degrees(law.residual_friction * path.friction0 + s.ruff * path.roughness0);
    t.limit1 =
        s.stress * tangent_of_degrees(law.residual_friction * path.friction1 + s.ruff * path.roughness1);
    // On the curve the trial is at least as steep as the curve, so that the strength is what limits it.
    const double slope = (t.limit1 - t.limit0) / std::max(path.motion, tiny);
    const double left = 1 - law.half_failure_ratio * path.swing / std::max(s.peak, tiny);
    const double hyperbola = std::max(0.0, left);
    t.stiffness =
        path.on_curve > 0 ? std::max(s.stiffness, slope) : s.stiffness * hyperbola * hyperbola; // (2.28)
    t.x = path.start_x - t.stiffness * path.motion_x;
    t.y = path.start_y - t.stiffness * path.motion_y;
    t.z = path.start_z - t.stiffness * path.motion_z;
    t.size = std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z);
    t.excess = std::max(0.0, t.size - t.limit0);
    const double part = std::min(1.0, t.excess / std::max(t.stiffness * path.motion, tiny));
    t.spent = path.motion * (path.on_curve > 0 ? 1 : part);
    // Half of the mobilised roughness angle (2.20); while B is negative there is none.
    t.dilation = tangent_of_degrees(0.25 * s.ruff * (path.roughness0 + path.roughness1));
    return t;
}

/// The steepest rise that the mobilised curve has at this normal stress: for the time step.
[[gnu::always_inline]] inline double steepest_rise(const Law& law, const Strength& s) {
    const double tangent = s.peak / std::max(s.stress, law.lowest_stress);
    const double degrees = std::max(0.75 / 0.20 * law.residual_friction, 0.50 / 0.15 * s.ruff);
    return s.stress * (1 + tangent * tangent) * degrees * law.radians_per_degree_and_peak;
}

ptrdiff_t run(kaya_jbatch* batch) {
    const Law law(given(batch->properties));
    const double log_jcs = logarithm(law.jcs);
    const double per_peak = 1 / law.peak_displacement;

    const double* areas = batch->area;
    const double* opening = batch->normal_disp_inc;
    const double* shear_x = batch->shear_disp_inc[0];
    const double* shear_y = batch->shear_disp_inc[1];
    const double* shear_z = batch->shear_disp_inc[2];
    double* normal_force = batch->normal_force;
    double* force_x = batch->shear_force[0];
    double* force_y = batch->shear_force[1];
    double* force_z = batch->shear_force[2];
    double* normal_stiffness = batch->normal_stiffness;
    double* shear_stiffness = batch->shear_stiffness;
    double* work = batch->frictional_work;
    uint32_t* states = batch->state;
    double* closures = batch->history[closure];
    double* spent_before = batch->history[mobilised];
    double* turn_x = batch->history[reversal_x];
    double* turn_y = batch->history[reversal_y];
    double* turn_z = batch->history[reversal_z];

#pragma GCC ivdep
    for (size_t i = 0; i < batch->n; ++i) {
        const double area = areas[i];
        const double per_area = area > 0 ? 1 / area : 0;
        const double before = spent_before[i];
        const double free_closure = closures[i] - opening[i]; // before dilation

        Path path;
        path.start_x = force_x[i] * per_area;
        path.start_y = force_y[i] * per_area;
        path.start_z = force_z[i] * per_area;
        path.motion_x = shear_x[i];
        path.motion_y = shear_y[i];
        path.motion_z = shear_z[i];
        path.motion = std::sqrt(path.motion_x * path.motion_x + path.motion_y * path.motion_y +
                                path.motion_z * path.motion_z);

        // The motion turns back when it works against the stress that it has built up since the last
        // turn; the stress is then counted from here (Masing).
        const double since_x = path.start_x - turn_x[i];
        const double since_y = path.start_y - turn_y[i];
        const double since_z = path.start_z - turn_z[i];
        const double along = -(since_x * path.motion_x + since_y * path.motion_y + since_z * path.motion_z);
        const bool turns = along < 0;
        const double from_x = turns ? path.start_x : turn_x[i];
        const double from_y = turns ? path.start_y : turn_y[i];
        const double from_z = turns ? path.start_z : turn_z[i];
        path.swing = turns ? 0 : std::sqrt(since_x * since_x + since_y * since_y + since_z * since_z);
        const double was_on_curve = (states[i] & is_unloading) != 0 ? 0 : 1;
        path.on_curve = turns ? 0 : was_on_curve;

        // Dilation can keep a joint closed whose sides move apart; it cannot close an open one.
        const double touching_motion = std::max(closures[i], free_closure) > 0 ? path.motion : 0;
        path.friction0 = mobilised_friction(before * per_peak);
        path.roughness0 = mobilised_roughness(before * per_peak);
        path.friction1 = mobilised_friction((before + touching_motion) * per_peak);
        path.roughness1 = mobilised_roughness((before + touching_motion) * per_peak);
        path.motion = touching_motion;

        // Dilation closes the joint further, which changes the normal stress, which changes dilation
        // and slip: two passes bring the error to a millionth of the dilation of the step.
        const Trial first = trial_at(law, strength_at(law, log_jcs, free_closure), path);
        const Trial second =
            trial_at(law, strength_at(law, log_jcs, free_closure + first.dilation * first.spent), path);
        const double new_closure = free_closure + second.dilation * second.spent;
        const Strength strength = strength_at(law, log_jcs, new_closure);
        const Trial last = trial_at(law, strength, path);

        const double spent = new_closure > 0 ? last.spent : 0;
        const double after = before + spent;
        const double limit = strength.stress *
                             tangent_of_degrees(law.residual_friction * mobilised_friction(after * per_peak) +
                                                strength.ruff * mobilised_roughness(after * per_peak));
        const double size = std::min(last.size, limit);
        const double scale = size / std::max(last.size, std::numeric_limits<double>::min());

        // Work of the plastic part of the slip, less what dilation lifts.
        const double start = std::sqrt(path.start_x * path.start_x + path.start_y * path.start_y +
                                       path.start_z * path.start_z);
        const double old_stress = normal_force[i] * per_area;
        const double elastic =
            (limit - last.limit0) / std::max(std::max(strength.stiffness, last.stiffness), law.lowest_stress);
        const double plastic = std::max(0.0, spent - elastic);
        const double taken_up =
            0.5 * (start + size) * plastic - 0.5 * (old_stress + strength.stress) * last.dilation * spent;
        work[i] += spent > 0 ? area * std::max(0.0, taken_up) : 0;

        normal_force[i] = strength.stress * area;
        force_x[i] = last.x * scale * area;
        force_y[i] = last.y * scale * area;
        force_z[i] = last.z * scale * area;
        normal_stiffness[i] = normal_tangent(law, new_closure);
        shear_stiffness[i] = std::max(strength.stiffness, steepest_rise(law, strength));
        closures[i] = new_closure;
        spent_before[i] = after;

        // After a separation the joint loads as it reloads: it keeps what it has spent.
        const double touches = new_closure > 0 ? 1 : 0;
        const double worn = before > 0 ? 0 : 1;
        const double reaches = last.excess > 0 ? 1 : path.on_curve;
        const double continues = touches > 0 ? reaches : worn;
        const double unloads = touches > 0 ? 1 - continues : 0;
        turn_x[i] = unloads * from_x;
        turn_y[i] = unloads * from_y;
        turn_z[i] = unloads * from_z;
        states[i] = (touches > 0 ? 0 : is_open) | (spent > 0 ? is_slipping : 0) |
                    (after > law.peak_displacement ? is_past_peak : 0) | (continues > 0 ? 0 : is_unloading);
    }
    batch->stiffness_changed = 1;
    return -1;
}

/// The displacement on the rising part of the mobilised curve at which it carries a shear stress.
double displacement_of_stress(const Law& law, const Strength& s, double shear_stress) {
    if (!(shear_stress > 0 && s.stress > 0)) return 0;
    double low = 0, high = law.peak_displacement;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high), x = middle / law.peak_displacement;
        const double angle = law.residual_friction * mobilised_friction(x) + s.ruff * mobilised_roughness(x);
        (s.stress * tangent_of_degrees(angle) < shear_stress ? low : high) = middle;
    }
    return high;
}

ptrdiff_t initialise(kaya_jbatch* batch) {
    const Law law(given(batch->properties));
    const double log_jcs = logarithm(law.jcs);
    for (size_t i = 0; i < batch->n; ++i) {
        const double per_area = batch->area[i] > 0 ? 1 / batch->area[i] : 0;
        const double stress = batch->normal_force[i] * per_area;
        double& closed = batch->history[closure][i];
        if (stress > 0)
            closed = closure_of_stress(law, stress);
        else
            closed = std::min({0.0, closed, -batch->normal_disp[i]});

        const Strength strength = strength_at(law, log_jcs, closed);
        const double shear_stress = per_area * std::hypot(batch->shear_force[0][i], batch->shear_force[1][i],
                                                          batch->shear_force[2][i]);
        // A shear force that is there must have been mobilised.
        double& spent = batch->history[mobilised][i];
        spent = std::max(spent, displacement_of_stress(law, strength, shear_stress));
        batch->normal_stiffness[i] = normal_tangent(law, closed);
        batch->shear_stiffness[i] = std::max(strength.stiffness, steepest_rise(law, strength));
    }
    return -1;
}

const char* check(const double* p) {
    constexpr struct {
        Property property;
        const char* message;
    } positive[] = {
        {stiffness_normal,
         "stiffness-normal (jkn, k_ni) is 0: give the stiffness of the joint at first touch"},
        {stiffness_shear, "stiffness-shear (jks, K_j) is 0: give the shear stiffness of the joint at 1 MPa"},
        {jrco, "jrco is 0: a joint without roughness has no closure curve, use jmodel mohr for it"},
        {jcso, "jcso is 0: give the wall strength of the joint"},
        {sigmac, "sigmac is 0: give the uniaxial compressive strength of the rock"},
        {mpa, "mpa is 0: give the value of 1 MPa in the deck's unit of stress"},
        {mm, "mm is 0: give the value of 1 mm in the deck's unit of length"},
    };
    for (const auto& entry : positive)
        if (!(p[entry.property] > 0)) return entry.message;
    const Given g = given(p);
    if (!(g.length_lab > 0)) return "lo is 0: give the length of the laboratory sample";
    if (!(g.length_field > 0)) return "ln is 0: give the length of the joint in the field";
    if (!(aperture(g) > 0))
        return "sigmac is not above half of jcso, which leaves no aperture (2.26): check both, and that they "
               "are in "
               "the same unit";
    if (!(maximum_closure(g) > 0))
        return "jrco, jcso and sigmac give a maximum closure that is not above 0 (2.25): check them, and "
               "that mpa is "
               "1 MPa in the deck's unit of stress";
    return nullptr;
}

void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[stiffness_normal];
    *shear = p[stiffness_shear];
}

constexpr kaya_jmodel descriptor = {
    KAYA_JMODEL_INTERFACE,
    sizeof(kaya_jmodel),
    "barton-bandis",
    "Barton-Bandis closure and mobilised roughness",
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
