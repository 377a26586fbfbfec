// One step of a Coulomb joint: what the models of that family share. Each gives its strength; opening, slip, dilation,
// failure and the account of work are the same in all. docs/joint-models/mohr.md has the equations; (n) are their numbers.
//
// The functions are straight lines of arithmetic and selections, with minima and maxima instead of conditions that
// depend on each other: so a loop over rows becomes vector instructions.
#pragma once

#include "kaya/jmodel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

namespace kaya::joints::coulomb {

inline double tan_degrees(double angle) { return std::tan(angle * (std::numbers::pi / 180)); }
inline double degrees_of_tangent(double tangent) { return std::atan(tangent) * (180 / std::numbers::pi); }

// --- rows of the tables of properties, history and states that several models have -----------------------------------

// Aliases are whole words: any leading part of one, as in jfric, is understood too.
inline constexpr kaya_jproperty stiffness_normal_row = {
    "stiffness-normal", "jkn kn", "stress/length", "normal stress per closure", NAN, 0, INFINITY, 0};
inline constexpr kaya_jproperty stiffness_shear_row = {
    "stiffness-shear", "jks ks", "stress/length", "shear stress per shear displacement", NAN, 0, INFINITY, 0};
inline constexpr kaya_jproperty friction_row = {
    "friction", "jfriction fric", "angle", "angle of friction before failure", 0, 0, 90, 0};
inline constexpr kaya_jproperty cohesion_row = {
    "cohesion", "jcohesion coh", "stress", "shear strength at zero normal stress before failure", 0, 0, INFINITY, 0};
inline constexpr kaya_jproperty tension_row = {
    "tension", "jtension ten", "stress", "tensile strength before failure", 0, 0, INFINITY, 0};
inline constexpr kaya_jproperty dilation_row = {
    "dilation", "jdilation dil", "angle", "angle of dilation while it slips", 0, 0, 89, 0};
inline constexpr kaya_jproperty dilation_zero_row = {
    "dilation-zero", "zdilation", "length", "slip at which dilation ends; 0: it does not end", 0, 0, INFINITY, 0};
inline constexpr kaya_jproperty friction_residual_row = {
    "friction-residual", "jrfriction", "angle", "angle of friction after failure; not given: that before",
    NAN, 0, 90, 1};
inline constexpr kaya_jproperty cohesion_residual_row = {
    "cohesion-residual", "jrcohesion", "stress", "cohesion after failure", 0, 0, INFINITY, 0};
inline constexpr kaya_jproperty tension_residual_row = {
    "tension-residual", "jrtension", "stress", "tensile strength after failure", 0, 0, INFINITY, 0};

inline constexpr kaya_jhistory gap_row = {
    "gap", "length", "opening beyond the displacement at which the tensile limit was reached"};
inline constexpr kaya_jhistory slip_row = {"slip", "length", "plastic shear displacement, added up"};

inline constexpr const char* state_names = "slip-now tension-now slip-past tension-past";
inline constexpr uint32_t slip_now = 1, tension_now = 2, tension_past = 8;
inline constexpr uint32_t now = slip_now | tension_now;
inline constexpr int from_now_to_past = 2; // places that a bit moves

/// What is wrong with values that the models share, or null.
inline const char* fault_of_stiffness(double normal, double shear) {
    if (!(normal > 0)) return "stiffness-normal (jkn) is 0: give the joint a normal stiffness";
    if (!(shear > 0)) return "stiffness-shear (jks) is 0: give the joint a shear stiffness";
    return nullptr;
}

inline const char* fault_of_residuals(double tension, double tension_residual, double cohesion,
                                      double cohesion_residual) {
    if (tension_residual > tension)
        return "tension-residual is above tension: failure cannot make the joint stronger, give a tension of "
               "at least that";
    if (cohesion_residual > cohesion)
        return "cohesion-residual is above cohesion: failure cannot make the joint stronger, give a cohesion "
               "of at least that";
    return nullptr;
}

// --- the step ------------------------------------------------------------------------------------------------------------

/// The columns that a step reads and writes.
struct Columns {
    const double *area, *opening, *shear_x, *shear_y, *shear_z;
    double *normal_force, *force_x, *force_y, *force_z, *work, *gaps, *slips;
    uint32_t* states;

    Columns(const kaya_jbatch& b, std::size_t gap, std::size_t slip)
        : area(b.area), opening(b.normal_disp_inc), shear_x(b.shear_disp_inc[0]), shear_y(b.shear_disp_inc[1]),
          shear_z(b.shear_disp_inc[2]), normal_force(b.normal_force), force_x(b.shear_force[0]),
          force_y(b.shear_force[1]), force_z(b.shear_force[2]), work(b.frictional_work), gaps(b.history[gap]),
          slips(b.history[slip]), states(b.state) {}
};

/// Coulomb's straight line: shear force that is carried at a normal force (4).
struct Line {
    double bond; ///< cohesion times area
    double tangent;

    [[gnu::always_inline]] double at(double normal) const { return std::max(0.0, bond + normal * tangent); }
    [[gnu::always_inline]] double slope(double) const { return tangent; }
};

/// No creep: the trial stands as it is.
struct Rigid {
    [[gnu::always_inline]] double relaxed(double trial) const { return trial; }
};

/// What holds in one step for one row; stresses.
struct Limits {
    double tension;          ///< at which the row breaks
    double residual_tension; ///< that it keeps when it has broken
    double dilatancy;        ///< tangent of the angle of dilation
    double last_dilation;    ///< slip at which dilation ends
};

/// What became of it.
struct Outcome {
    double slipped; ///< plastic shear displacement of the step
    bool slips, breaks;
};

/// One row, one step. `strength.at(normal force)` is the shear force that it carries and `strength.slope` its
/// derivative; `creep.relaxed(force)` is what is left of an elastic shear force at the end of the step.
template <class Strength, class Creep = Rigid>
[[gnu::always_inline]] inline Outcome step(const Columns& c, std::size_t i, double kn, double ks,
                                           const Limits& limits, const Strength& strength,
                                           const Creep& creep = Creep()) {
    const double area = c.area[i], old_gap = c.gaps[i], old_normal = c.normal_force[i];
    const double per_area = area > 0 ? 1 / area : 0;

    // Normal: the spring acts on the displacement beyond the gap (1), up to the tensile limit (2). A failed joint
    // without tension parts: beyond a gap of 0 its sides touch no more.
    const double touching_gap = limits.residual_tension > 0 ? INFINITY : 0;
    const double lowest = -limits.residual_tension * area;
    const double held = old_gap > 0 ? lowest : old_normal;
    const double pulled = held - kn * area * (old_gap + c.opening[i]);
    const bool breaks = pulled < -limits.tension * area;
    const double stretched = breaks ? (lowest - pulled) * per_area / kn : 0;
    const double new_gap = area > 0 ? stretched : std::max(0.0, old_gap + c.opening[i]);
    const double elastic_normal = breaks ? lowest : pulled;
    const bool apart = new_gap > touching_gap;

    // Shear: elastic trial (3), less what creep lets go, against the limit (4).
    const double old_x = c.force_x[i], old_y = c.force_y[i], old_z = c.force_z[i];
    const double trial_x = old_x - ks * area * c.shear_x[i];
    const double trial_y = old_y - ks * area * c.shear_y[i];
    const double trial_z = old_z - ks * area * c.shear_z[i];
    const double elastic = std::sqrt(trial_x * trial_x + trial_y * trial_y + trial_z * trial_z);
    const double trial = creep.relaxed(elastic);
    const double excess = apart ? 0 : std::max(0.0, trial - strength.at(elastic_normal));

    // Dilation raises the normal force and with it the limit: slip that brings trial and limit together (5), as far
    // as dilation lasts; the rest of the slip follows at the new limit (6).
    const double both = excess * per_area / (ks + kn * limits.dilatancy * strength.slope(elastic_normal));
    const double dilating = std::min(both, std::max(0.0, limits.last_dilation - c.slips[i]));
    const double new_normal = elastic_normal + kn * area * limits.dilatancy * dilating;
    const double most = apart ? 0 : strength.at(new_normal);
    const double limit = std::min(trial, most);
    const double slipped = (elastic - limit) * per_area / ks;
    const double divisor = std::max(elastic, std::numeric_limits<double>::min());
    const double scale = limit / divisor; // exactly 1 where it neither yields nor creeps

    // Work taken up: mean force times slip, less what dilation lifts (7); and the energy of a bond that breaks in
    // tension.
    const double along_old = (old_x * trial_x + old_y * trial_y + old_z * trial_z) / divisor;
    const double sheared = 0.5 * (along_old + limit) * slipped;
    const double lifted = 0.5 * (old_normal + new_normal) * limits.dilatancy * dilating;
    const double pull = std::min(0.0, old_normal);
    const double lost = 0.5 * std::max(0.0, pull * pull - lowest * lowest) * per_area / kn;
    c.work[i] += sheared - lifted + (breaks ? lost : 0);

    c.normal_force[i] = new_normal;
    c.force_x[i] = trial_x * scale;
    c.force_y[i] = trial_y * scale;
    c.force_z[i] = trial_z * scale;
    c.gaps[i] = new_gap;
    c.slips[i] += apart ? 0 : slipped;
    c.states[i] = (c.states[i] & ~now) | ((c.states[i] & now) << from_now_to_past) | (excess > 0 ? slip_now : 0) |
                  (breaks ? tension_now : 0);
    return {apart ? 0 : slipped, excess > 0, breaks};
}

/// New rows: what is apart has a gap, and no bond that could pull it together.
inline void initialise(kaya_jbatch& b, std::size_t gap, double kn, double ks) {
    // A gap of this part of the size of the sub-contact is rounding of coordinates, and is none.
    constexpr double rounding = 1e-9;
    for (std::size_t i = 0; i < b.n; ++i) {
        b.normal_stiffness[i] = kn;
        b.shear_stiffness[i] = ks;
        const double apart = b.normal_disp[i] > rounding * std::sqrt(b.area[i]) ? b.normal_disp[i] : 0;
        const bool loaded = b.normal_force[i] != 0;
        const double opened = b.history[gap][i] > 0 ? b.history[gap][i] : apart;
        b.history[gap][i] = loaded ? 0 : opened;
        if (!loaded && opened > 0) b.state[i] |= tension_past;
    }
}

} // namespace kaya::joints::coulomb
