// Joint model `barton-bandis`: hyperbolic closure and mobilised roughness.
// docs/joint-models/barton-bandis.md has the equations; (n) below are their numbers.
#include "kaya/jmodel.h"
#include "kaya/law/own_properties.hpp"
#include "kaya/law/rounding.hpp"
#include "kaya/law/rows.hpp"
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
    stepped_mobilisation,
    loading_hyperbola,
    residual_at_slip,
    contraction,
    dilation_jcso,
    strength_factor,
    property_count
};

constexpr kaya_jproperty properties[] = {
    {"stiffness-normal", "jkn kn kni", "stress/length", "normal stiffness at first contact, k_ni", NAN, 0, INFINITY, 0},
    {"stiffness-shear", "jks ks kj", "stress/length", "shear stiffness at a normal stress of 1 MPa, K_j", NAN, 0,
     INFINITY, 0},
    {"friction-residual", "resfriction jrfric", "angle", "residual angle of friction, phi_r", NAN, 0, 69, 0},
    {"jrco", "jrc", "-", "roughness coefficient of the laboratory sample, JRC_o", NAN, 0, INFINITY, 0},
    {"jcso", "jcs", "stress", "wall strength of the laboratory sample, JCS_o", NAN, 0, INFINITY, 0},
    {"sigmac", "", "stress", "uniaxial compressive strength of the rock", NAN, 0, INFINITY, 0},
    {"nj", "", "-", "exponent of normal stress in the shear stiffness", 0.8, 0, 4, 0},
    {"rf", "", "-", "failure ratio R_f of the unloading curve", 1, 0, 1, 0},
    {"lo", "", "length", "length of the laboratory sample; not given: 100 mm", NAN, 0, INFINITY, 1},
    {"ln", "", "length", "length of the joint in the field; not given: that of the sample", NAN, 0, INFINITY, 1},
    {"large", "", "-", "1: jrco and jcso are those of the joint itself, without scaling", 0, 0, 1, 0},
    {"mpa", "", "stress", "1 MPa in the deck's unit of stress", 1, 0, INFINITY, 0},
    {"mm", "", "length", "1 mm in the deck's unit of length", 1e-3, 0, INFINITY, 0},
    {"delta-peak-lo", "", "-", "1: peak displacement with the sample's length in the root", 0, 0, 1, 0},
    {"stepped-mobilisation", "", "-", "1: B of the table is held from each row to the next", 0, 0, 1, 0},
    {"loading-hyperbola", "", "-", "1: the shear stress climbs with (2.28), not along the mobilised curve", 0, 0, 1, 0},
    {"residual-at-slip", "", "-", "1: the strength is the residual one after the first slip", 0, 0, 1, 0},
    {"contraction", "", "-", "1: negative mobilised roughness closes the joint", 0, 0, 1, 0},
    {"dilation-jcso", "", "-", "1: dilation from the wall strength of the sample, JCS_o", 0, 0, 1, 0},
    {"strength-factor", "", "-", "the shear strength is divided by it; solve fos sets it", 1, 1e-6, 1e6, 0},
};
static_assert(std::size(properties) == property_count);

enum History { closure, mobilised, reversal_x, reversal_y, reversal_z, built, waiting, history_count };

constexpr kaya_jhistory history[] = {
    {"closure", "length", "closure of the joint; negative: how far it is open"},
    {"mobilised", "length", "shear displacement spent on the mobilised curve"},
    {"reversal-x", "stress", "shear stress at the last reversal of the motion"},
    {"reversal-y", "stress", "shear stress at the last reversal of the motion"},
    {"reversal-z", "stress", "shear stress at the last reversal of the motion"},
    {"built", "stress", "shear stress to which the joint returns when the normal stress does"},
    {"waiting", "stress*length", "energy of shear beyond what the strength lets the joint store"},
};
static_assert(std::size(history) == history_count);

/// Properties that may differ from one sub-contact to the next.
constexpr kaya_jfield fields[] = {
    {"jrco", "-", "roughness coefficient, where it differs", 0},
    {"jcso", "stress", "wall strength, where it differs", 0},
    {"sigmac", "stress", "uniaxial compressive strength of the rock, where it differs", 0},
    {"friction-residual", "angle", "residual angle of friction, where it differs", 0},
    {"stiffness-normal", "stress/length", "normal stiffness at first contact, where it differs", 0},
    {"stiffness-shear", "stress/length", "shear stiffness at a normal stress of 1 MPa, where it differs", 0},
};
constexpr size_t field_count = std::size(fields);
constexpr size_t property_of_field[field_count] = {jrco,           jcso, sigmac, friction_residual, stiffness_normal,
                                                   stiffness_shear};

constexpr const char* state_names = "open slipping past-peak unloading fallen";
constexpr uint32_t is_open = 1, is_slipping = 2, is_past_peak = 4, is_unloading = 8, has_fallen = 16;

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
            p[mm],
            p[stepped_mobilisation] != 0,
            p[loading_hyperbola] != 0,
            p[residual_at_slip] != 0,
            p[contraction] != 0,
            p[dilation_jcso] != 0,
            p[strength_factor]};
}

/// Values that depend on the normal stress.
struct Strength {
    double stress, ruff, stiffness, peak;
};

/// The steepest rise that the mobilised curve has at a normal stress.
[[gnu::always_inline]] inline double steepest_rise(const Law& law, double stress, double ruff, double peak) {
    const double tangent = peak / std::max(stress, law.lowest_stress);
    const double degrees = std::max(0.75 / 0.20 * law.residual_friction, 0.50 / 0.15 * ruff);
    return stress * (1 + tangent * tangent) * degrees * law.radians_per_degree_and_peak;
}

[[gnu::always_inline]] inline Strength strength_at(const Law& law, double log_jcs, double closure_) {
    const double stress = normal_stress(law, closure_);
    const double log_stress = logarithm(std::max(stress, law.lowest_stress));
    const double ruff = roughness_angle(law, log_stress, log_jcs);
    const double whole = stress * tangent_of_degrees(law.residual_friction + ruff);
    // K_j sigma_n^n_j (2.28), sigma_n in MPa; 0 when open, where the logarithm was cut.
    const double power_of_stress = exponential(law.stiffness_exponent * (log_stress + logarithm(law.per_mpa)));
    const double given = stress > 0 ? law.shear_stiffness * power_of_stress : 0;
    // Unloading with (2.28) returns at most 0.773 tau^2/K, loading along the curve takes at least tau^2/(2 rise): with K at least twice the
    // rise no cycle creates energy.
    return {stress, ruff, std::max(given, 2 * law.part * steepest_rise(law, stress, ruff, whole)), law.part * whole};
}

/// The shear path of one step, in stresses: its start and its length.
struct Path {
    double start_x, start_y, start_z;    ///< shear stress before
    double motion_x, motion_y, motion_z; ///< shear displacement increment
    double motion;                       ///< its length
    double swing;                        ///< stress since the last reversal
    double stiffness;                    ///< K_j sigma_n^n_j before the step
    Mobilised before, after;             ///< if all of the motion is spent on the curve
    double on_curve;                     ///< 1: the motion follows the mobilised curve; 0: unloading or reloading
    double fallen;                       ///< 1: the residual strength holds
    double from_x, from_y, from_z;       ///< stress at the last reversal
    double spent_before;                 ///< displacement spent on the curve
    double size;                         ///< of the shear stress before
    double built;                        ///< shear stress to which the joint returns when the normal stress does
    double waits;                        ///< energy of shear that the strength did not let the joint store
    double energy;                       ///< of shear, with what waits
    double free_closure;                 ///< closure without dilation
};

/// The elastic trial, and the part of the motion along the mobilised curve.
struct Trial {
    double kept;    ///< how many times the stress before is left
    double held;    ///< that stress
    double waiting; ///< energy that the strength does not let the joint store
    double x, y, z, size;
    double stiffness;
    double limit0, limit1; ///< mobilised strength before, and if all of the motion is spent
    double excess;
    double spent;    ///< displacement
    double dilation; ///< tangent of the mean dilation angle
};

template <bool thesis> [[gnu::always_inline]] inline double mobilised_strength(const Law& law, const Strength& s,
                                                                               const Mobilised& m, double fallen) {
    const double angle = law.residual_friction * m.friction + s.ruff * m.roughness;
    if constexpr (thesis) return law.part * s.stress * tangent_of_degrees(fallen > 0 ? law.residual_friction : angle);
    return law.part * s.stress * tangent_of_degrees(angle);
}

template <bool thesis>
[[gnu::always_inline]] inline Trial trial_at(const Law& law, const Strength& s, const Path& path) {
    constexpr double tiny = std::numeric_limits<double>::min();
    Trial t;
    t.limit0 = mobilised_strength<thesis>(law, s, path.before, path.fallen);
    t.limit1 = mobilised_strength<thesis>(law, s, path.after, path.fallen);
    // A change of the normal stress adds no shear stress and keeps the energy of shear. What the strength does not let the joint store waits
    // until the normal stress comes back.
    const double stored = path.on_curve > 0 ? path.energy : path.energy - path.waits;
    const double most = std::min(std::sqrt(2 * s.stiffness * stored), std::max(t.limit0, 0.0));
    t.held = path.stiffness > 0 && path.size > 0 ? std::min(most, path.built) : path.size;
    t.kept = path.size > 0 ? t.held / path.size : 1;
    t.waiting = std::max(0.0, path.energy - 0.5 * t.held * t.held / std::max(s.stiffness, tiny));
    // On the curve the trial is at least as steep as the curve, so that the strength limits it.
    const double slope = (t.limit1 - t.limit0) / std::max(path.motion, tiny);
    const double left = 1 - law.half_failure_ratio * path.swing * t.kept / std::max(s.peak, tiny);
    const double hyperbola = std::max(0.0, left);
    t.stiffness = path.on_curve > 0 ? std::max(s.stiffness, slope) : s.stiffness * hyperbola * hyperbola; // (2.28)
    if constexpr (thesis) {
        const double start = t.kept * path.size;
        const double loading = std::max(0.0, 1 - 2 * law.half_failure_ratio * start / std::max(s.peak, tiny));
        t.stiffness = law.hyperbolic && path.on_curve > 0 ? s.stiffness * loading * loading : t.stiffness;
    }
    t.x = t.kept * path.start_x - t.stiffness * path.motion_x;
    t.y = t.kept * path.start_y - t.stiffness * path.motion_y;
    t.z = t.kept * path.start_z - t.stiffness * path.motion_z;
    t.size = std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z);
    t.excess = std::max(0.0, t.size - t.limit0);
    const double part = std::min(1.0, t.excess / std::max(t.stiffness * path.motion, tiny));
    t.spent = path.motion * (path.on_curve > 0 ? 1 : part);
    // Half of the mobilised roughness angle (2.20); while B is negative there is none.
    double angle = 0.25 * s.ruff * (path.before.roughness + path.after.roughness);
    if constexpr (thesis) {
        angle = 0.25 * (s.ruff + law.more_dilation) * (path.before.roughness + path.after.roughness);
        angle -= law.contracts ? 0.25 * law.residual_friction * (2 - path.before.friction - path.after.friction) : 0;
    }
    t.dilation = tangent_of_degrees(angle);
    return t;
}

/// The columns of a batch.
struct Rows {
    explicit Rows(kaya_jbatch& b)
        : areas(b.area), opening(b.normal_disp_inc), shear_x(b.shear_disp_inc[0]), shear_y(b.shear_disp_inc[1]),
          shear_z(b.shear_disp_inc[2]), normal_force(b.normal_force), force_x(b.shear_force[0]),
          force_y(b.shear_force[1]), force_z(b.shear_force[2]), normal_stiffness(b.normal_stiffness),
          shear_stiffness(b.shear_stiffness), work(b.frictional_work), closures(b.history[closure]),
          spent_before(b.history[mobilised]), turn_x(b.history[reversal_x]), turn_y(b.history[reversal_y]),
          turn_z(b.history[reversal_z]), builds(b.history[built]), waits(b.history[waiting]), states(b.state) {}

    const double *areas, *opening, *shear_x, *shear_y, *shear_z;
    double *normal_force, *force_x, *force_y, *force_z, *normal_stiffness, *shear_stiffness, *work, *closures,
        *spent_before, *turn_x, *turn_y, *turn_z, *builds, *waits;
    uint32_t* states;
};

template <bool thesis> [[gnu::always_inline]] inline Path path_of(const Rows& r, const Law& law, size_t i) {
    const double per_area = r.areas[i] > 0 ? 1 / r.areas[i] : 0;
    Path path;
    path.spent_before = r.spent_before[i];
    path.free_closure = r.closures[i] - r.opening[i];
    path.start_x = r.force_x[i] * per_area;
    path.start_y = r.force_y[i] * per_area;
    path.start_z = r.force_z[i] * per_area;
    path.motion_x = r.shear_x[i];
    path.motion_y = r.shear_y[i];
    path.motion_z = r.shear_z[i];
    const double motion =
        std::sqrt(path.motion_x * path.motion_x + path.motion_y * path.motion_y + path.motion_z * path.motion_z);

    // The motion turns back when it works against the stress that it has built up since the last
    // turn; the stress is then counted from here (Masing).
    const double since_x = path.start_x - r.turn_x[i];
    const double since_y = path.start_y - r.turn_y[i];
    const double since_z = path.start_z - r.turn_z[i];
    const double along = -(since_x * path.motion_x + since_y * path.motion_y + since_z * path.motion_z);
    const bool turns = along < 0;
    path.from_x = turns ? path.start_x : r.turn_x[i];
    path.from_y = turns ? path.start_y : r.turn_y[i];
    path.from_z = turns ? path.start_z : r.turn_z[i];
    path.stiffness = r.shear_stiffness[i]; // of the step before, or of initialise
    path.swing = turns ? 0 : std::sqrt(since_x * since_x + since_y * since_y + since_z * since_z);
    const double was_on_curve = (r.states[i] & is_unloading) != 0 ? 0 : 1;
    path.on_curve = turns ? 0 : was_on_curve;
    const double square = path.start_x * path.start_x + path.start_y * path.start_y + path.start_z * path.start_z;
    path.size = std::sqrt(square);
    path.built = std::max(path.size, r.builds[i]);
    path.waits = r.waits[i];
    // Without a spring no energy is stored, whatever force was set.
    path.energy = (path.stiffness > 0 ? 0.5 * square / path.stiffness : 0) + r.waits[i];

    // Dilation can keep a joint closed whose sides separate; it cannot close an open one.
    const double closed = r.closures[i], most_closed = closed < path.free_closure ? path.free_closure : closed;
    path.motion = most_closed > 0 ? motion : 0;
    path.before = mobilised_at<thesis>(law, path.spent_before);
    path.after = mobilised_at<thesis>(law, path.spent_before + path.motion);
    path.fallen = thesis && (r.states[i] & has_fallen) != 0 ? 1 : 0;
    return path;
}

/// Forces, work and state of row `i` at the end of the step.
template <bool thesis> [[gnu::always_inline]] inline void end_row(const Rows& r, const Law& law, size_t i,
                                                                  const Path& path, const Strength& strength,
                                                                  const Trial& last, double new_closure) {
    constexpr double tiny = std::numeric_limits<double>::min();
    const double area = r.areas[i];
    const double per_area = area > 0 ? 1 / area : 0;
    const double spent = new_closure > 0 ? last.spent : 0;
    const double after = path.spent_before + spent;
    const double limit = mobilised_strength<thesis>(law, strength, mobilised_at<thesis>(law, after), path.fallen);
    const double trial = last.size, size = limit < trial ? limit : trial;
    const double scale = size / std::max(trial, tiny);
    const double end_x = last.x * scale, end_y = last.y * scale, end_z = last.z * scale;

    // Work that is neither stored in the springs nor spent on dilation.
    const double worked = -0.5 * ((path.start_x + end_x) * path.motion_x + (path.start_y + end_y) * path.motion_y +
                                  (path.start_z + end_z) * path.motion_z);
    const double now = strength.stiffness;
    const double waits = new_closure > 0 ? last.waiting : 0;
    const double stored = (now > 0 ? 0.5 * size * size / now : 0) + waits - path.energy;
    const double lifted = 0.5 * (r.normal_force[i] * per_area + strength.stress) * last.dilation * spent;
    r.work[i] += area * (worked - stored - lifted);

    r.normal_force[i] = strength.stress * area;
    r.force_x[i] = end_x * area;
    r.force_y[i] = end_y * area;
    r.force_z[i] = end_z * area;
    r.normal_stiffness[i] = normal_tangent(law, new_closure);
    r.shear_stiffness[i] = now;
    r.closures[i] = new_closure;
    r.spent_before[i] = after;

    // After a separation the joint loads along its reloading curve: the mobilised part is kept.
    const double closes = new_closure > 0 ? 1 : 0;
    const double worn = path.spent_before > 0 ? 0 : 1;
    const double reaches = last.excess > 0 ? 1 : path.on_curve;
    const double continues = closes > 0 ? reaches : worn;
    const double unloads = closes > 0 ? 1 - continues : 0;
    r.builds[i] = new_closure > 0 ? size + path.built - last.held : 0;
    r.waits[i] = waits;
    r.turn_x[i] = unloads * last.kept * path.from_x;
    r.turn_y[i] = unloads * last.kept * path.from_y;
    r.turn_z[i] = unloads * last.kept * path.from_z;
    r.states[i] = (closes > 0 ? 0 : is_open) | (spent > 0 ? is_slipping : 0) |
                  (after > law.peak_displacement ? is_past_peak : 0) | (continues > 0 ? 0 : is_unloading) |
                  (thesis ? (r.states[i] & has_fallen) | (law.falls && last.excess > 0 ? has_fallen : 0) : 0);
}

template <bool thesis> void run_rows(kaya_jbatch* batch, const Law& law) {
    const double log_jcs = logarithm(law.jcs);
    const Rows rows(*batch);
    KAYA_INDEPENDENT_ROWS
    for (size_t i = 0; i < batch->n; ++i) {
        const Path path = path_of<thesis>(rows, law, i);
        // Dilation closes the joint further, which changes the normal stress, which changes dilation
        // and slip: two passes bring the error to a millionth of the dilation of the step.
        const Trial first = trial_at<thesis>(law, strength_at(law, log_jcs, path.free_closure), path);
        const Trial second =
            trial_at<thesis>(law, strength_at(law, log_jcs, path.free_closure + first.dilation * first.spent), path);
        const double closed = path.free_closure + second.dilation * second.spent;
        const Strength strength = strength_at(law, log_jcs, closed);
        end_row<thesis>(rows, law, i, path, strength, trial_at<thesis>(law, strength, path), closed);
    }
    batch->stiffness_changed = 1;
}

ptrdiff_t run_alike(kaya_jbatch* batch) {
    const Law law(given(batch->properties));
    if (law.plain()) run_rows<false>(batch, law);
    else run_rows<true>(batch, law);
    return -1;
}

/// The displacement on the rising part of the mobilised curve at which it carries a shear stress.
double displacement_of_stress(const Law& law, const Strength& s, double shear_stress) {
    if (!(shear_stress > 0 && s.stress > 0)) return 0;
    double low = 0, high = law.peak_displacement;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        const Mobilised there = mobilised_at<true>(law, middle);
        (mobilised_strength<true>(law, s, there, 0) < shear_stress ? low : high) = middle;
    }
    return high;
}

ptrdiff_t initialise_alike(kaya_jbatch* batch) {
    const Law law(given(batch->properties));
    const double log_jcs = logarithm(law.jcs);
    for (size_t i = 0; i < batch->n; ++i) {
        const double per_area = batch->area[i] > 0 ? 1 / batch->area[i] : 0;
        const double stress = batch->normal_force[i] * per_area;
        double& closed = batch->history[closure][i];
        if (stress > 0) closed = closure_of_stress(law, stress);
        else closed = std::min({0.0, closed, -batch->normal_disp[i]});

        const Strength strength = strength_at(law, log_jcs, closed);
        const double shear_stress =
            per_area * std::hypot(batch->shear_force[0][i], batch->shear_force[1][i], batch->shear_force[2][i]);
        // An existing shear force must have been mobilised.
        double& spent = batch->history[mobilised][i];
        if (beyond_rounding(closed, batch->area[i]))
            spent = std::max(spent, displacement_of_stress(law, strength, shear_stress));
        batch->normal_stiffness[i] = normal_tangent(law, closed);
        batch->shear_stiffness[i] = strength.stiffness;
    }
    return -1;
}

const char* check(const double* p) {
    constexpr struct {
        Property property;
        const char* message;
    } positive[] = {
        {stiffness_normal, "stiffness-normal (jkn, k_ni) is 0: give the stiffness of the joint at first contact"},
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

template <class Run> ptrdiff_t by_values(kaya_jbatch* batch, Run run) {
    return by_properties<property_count, history_count>(batch, property_of_field, check, run);
}

ptrdiff_t run(kaya_jbatch* batch) { return by_values(batch, run_alike); }

ptrdiff_t initialise(kaya_jbatch* batch) { return by_values(batch, initialise_alike); }

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
    nullptr,
    fields,
    field_count,
};

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return &descriptor; }
