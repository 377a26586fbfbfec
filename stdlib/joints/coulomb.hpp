// One step of a Coulomb joint, shared by the models of that family. Each model defines its strength; opening, slip, dilation, failure and
// the account of work are the same in all. docs/joint-models/mohr.md has the equations; (n) are their numbers.
//
// The functions are straight-line arithmetic and selections, with minima and maxima instead of nested conditions: so a loop over rows
// becomes vector instructions.
#pragma once

#include "kaya/jmodel.h"
#include "kaya/law/rounding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

namespace kaya::joints::coulomb {

inline double tan_degrees(double angle) { return std::tan(angle * (std::numbers::pi / 180)); }

// --- tables: rows that most models share, before those of the model -----------------------------------------------------

enum Property : std::size_t {
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
inline constexpr std::array<kaya_jproperty, property_count> properties = {{
    {"stiffness-normal", "jkn kn", "stress/length", "normal stress per closure", NAN, 0, INFINITY, 0},
    {"stiffness-shear", "jks ks", "stress/length", "shear stress per shear displacement", NAN, 0, INFINITY, 0},
    {"friction", "jfriction fric", "angle", "angle of friction before failure", 0, 0, 90, 0},
    {"cohesion", "jcohesion coh", "stress", "shear strength at zero normal stress before failure", 0, 0, INFINITY, 0},
    {"tension", "jtension ten", "stress", "tensile strength before failure", 0, 0, INFINITY, 0},
    {"dilation", "jdilation dil", "angle", "angle of dilation while it slips", 0, 0, 89, 0},
    {"dilation-zero", "zdilation zerdilation", "length", "slip at which dilation ends; 0: it does not end", 0, 0,
     INFINITY, 0},
    {"friction-residual", "jrfriction resfriction", "angle", "angle of friction after failure; not given: that before",
     NAN, 0, 90, 1},
    {"cohesion-residual", "jrcohesion rescohesion", "stress", "cohesion after failure", 0, 0, INFINITY, 0},
    {"tension-residual", "jrtension restension", "stress", "tensile strength after failure", 0, 0, INFINITY, 0},
}};

enum History : std::size_t { gap, slip, history_count };

inline constexpr std::array<kaya_jhistory, history_count> history = {{
    {"gap", "length", "opening beyond the displacement at which the tensile limit was reached"},
    {"slip", "length", "plastic shear displacement, added up"},
}};

/// History of dilation, after the other history of a model; the model's Columns know its first row.
inline constexpr std::array<kaya_jhistory, 4> history_of_dilation = {{
    {"dilated", "length", "opening that dilation has brought and holds now"},
    {"dilating-x", "length", "plastic shear displacement from where dilation began"},
    {"dilating-y", "length", "plastic shear displacement from where dilation began"},
    {"dilating-z", "length", "plastic shear displacement from where dilation began"},
}};

/// The shared rows, followed by those of a model.
template <class Row, std::size_t shared, std::size_t own>
constexpr std::array<Row, shared + own> operator+(const std::array<Row, shared>& first,
                                                  const std::array<Row, own>& more) {
    std::array<Row, shared + own> rows{};
    std::copy(first.begin(), first.end(), rows.begin());
    std::copy(more.begin(), more.end(), rows.begin() + shared);
    return rows;
}

inline constexpr const char* state_names = "slip-now tension-now slip-past tension-past";
inline constexpr uint32_t slip_now = 1, tension_now = 2, tension_past = 8;
inline constexpr uint32_t now = slip_now | tension_now;
inline constexpr int from_now_to_past = 2; // places that a bit moves

/// Why the shared values are invalid, or null.
inline const char* fault_of_stiffness(double normal, double shear) {
    if (!(normal > 0)) return "stiffness-normal (jkn) is 0: give the joint a normal stiffness";
    if (!(shear > 0)) return "stiffness-shear (jks) is 0: give the joint a shear stiffness";
    return nullptr;
}

inline const char* fault_of_residuals(double tension_before, double tension_after, double cohesion_before,
                                      double cohesion_after) {
    if (tension_after > tension_before)
        return "tension-residual is above tension: failure cannot make the joint stronger, give a tension of "
               "at least that";
    if (cohesion_after > cohesion_before)
        return "cohesion-residual is above cohesion: failure cannot make the joint stronger, give a cohesion "
               "of at least that";
    return nullptr;
}

inline const char* check(const double* p) {
    if (const char* fault = fault_of_stiffness(p[stiffness_normal], p[stiffness_shear])) return fault;
    return fault_of_residuals(p[tension], p[tension_residual], p[cohesion], p[cohesion_residual]);
}

// --- the step ------------------------------------------------------------------------------------------------------------

/// The columns that a step reads and writes.
struct Columns {
    const double *area, *opening, *shear_x, *shear_y, *shear_z;
    double *normal_force, *force_x, *force_y, *force_z, *work, *gaps, *slips;
    double *dilated, *travel_x, *travel_y, *travel_z;
    uint32_t* states;

    Columns(const kaya_jbatch& b, std::size_t dilation_at)
        : area(b.area), opening(b.normal_disp_inc), shear_x(b.shear_disp_inc[0]), shear_y(b.shear_disp_inc[1]),
          shear_z(b.shear_disp_inc[2]), normal_force(b.normal_force), force_x(b.shear_force[0]),
          force_y(b.shear_force[1]), force_z(b.shear_force[2]), work(b.frictional_work), gaps(b.history[gap]),
          slips(b.history[slip]), dilated(b.history[dilation_at]), travel_x(b.history[dilation_at + 1]),
          travel_y(b.history[dilation_at + 2]), travel_z(b.history[dilation_at + 3]), states(b.state) {}
};

/// Coulomb's straight line: shear force that is carried at a normal force (4).
struct Line {
    double bond; ///< cohesion times area
    double tangent;

    [[gnu::always_inline]] double at(double normal) const { return std::max(0.0, bond + normal * tangent); }
    [[gnu::always_inline]] double slope(double) const { return tangent; }
};

/// Strength limits of one row in one step; stresses.
struct Limits {
    double tension;          ///< at which the row breaks
    double residual_tension; ///< after tensile failure
    double dilatancy;        ///< tangent of the angle of dilation
    double last_dilation;    ///< slip at which dilation ends
};

/// The shared properties in the form that a loop over rows needs.
struct Values {
    double kn, ks;
    double tension[2], cohesion[2], tangent[2]; ///< before and after failure
    double dilatancy, last_dilation;

    explicit Values(const double* p)
        : kn(p[stiffness_normal]),
          ks(p[stiffness_shear]), tension{p[coulomb::tension], p[tension_residual]}, cohesion{p[coulomb::cohesion],
                                                                                              p[cohesion_residual]},
          tangent{tan_degrees(p[friction]),
                  tan_degrees(std::isnan(p[friction_residual]) ? p[friction] : p[friction_residual])},
          dilatancy(tan_degrees(p[dilation])), last_dilation(p[dilation_zero] > 0 ? p[dilation_zero] : INFINITY) {}

    /// A selection instead of an indexed load: it becomes a vector instruction.
    [[gnu::always_inline]] static double of(const double (&pair)[2], bool failed) { return failed ? pair[1] : pair[0]; }
    [[gnu::always_inline]] Line line(bool failed, double area) const {
        return {of(cohesion, failed) * area, of(tangent, failed)};
    }
    [[gnu::always_inline]] Limits limits(bool failed) const {
        return {of(tension, failed), tension[1], dilatancy, last_dilation};
    }
};

struct Shear {
    double x, y, z;
};

[[gnu::always_inline]] inline double length(const Shear& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// Dilation of a row: the opening increases with the distance of the slip from its start, up to `end`, and decreases with it, so that it is
/// 0 when the slip has returned.
struct Climb {
    double along, across2; ///< slip so far, in the direction of the step and the square of it across
    double height;         ///< distance, at most `end`
    double rise, fall;     ///< opening per distance of forward and of reverse slip
    double end;

    /// `way` is the unit vector of the step's slip.
    [[gnu::always_inline]] static Climb of(const Columns& c, std::size_t i, const Shear& travel, double dilatancy,
                                           double end) {
        const double along = c.travel_x[i] * travel.x + c.travel_y[i] * travel.y + c.travel_z[i] * travel.z;
        const double distance2 =
            c.travel_x[i] * c.travel_x[i] + c.travel_y[i] * c.travel_y[i] + c.travel_z[i] * c.travel_z[i];
        const double height = std::min(std::sqrt(distance2), end);
        const double fall = c.dilated[i] / std::max(height, std::numeric_limits<double>::min());
        return {along, std::max(0.0, distance2 - along * along), height, dilatancy, fall, end};
    }

    /// Opening after more slip, less that before it.
    [[gnu::always_inline]] double change(double slipped) const {
        const double there = along + slipped;
        const double climbed = std::min(std::sqrt(across2 + there * there), end) - height;
        return climbed * (climbed > 0 ? rise : fall);
    }

    /// Its derivative.
    [[gnu::always_inline]] double slope(double slipped) const {
        const double there = along + slipped, distance = std::sqrt(across2 + there * there);
        const double even = there / std::max(distance, std::numeric_limits<double>::min());
        return distance < end ? even * (distance > height ? rise : fall) : 0;
    }
};

/// No creep: the trial is unchanged.
struct Rigid {
    [[gnu::always_inline]] double relaxed(double trial) const { return trial; }
};

/// Result of a step.
struct Outcome {
    double slipped; ///< plastic shear displacement of the step
    double excess;  ///< of the shear force above the strength; above 0 when it slips and does not only creep
};

/// Shear force of a row that does not slip (3).
[[gnu::always_inline]] inline Shear elastic_shear(const Columns& c, std::size_t i, double ks) {
    const double k = ks * c.area[i];
    return {c.force_x[i] - k * c.shear_x[i], c.force_y[i] - k * c.shear_y[i], c.force_z[i] - k * c.shear_z[i]};
}

/// One row, one step. `strength.at(normal force)` is the shear strength as a force and `strength.slope` its derivative;
/// `creep.relaxed(force)` is the elastic shear force at the end of the step.
template <bool dilates, class Strength, class Creep = Rigid>
[[gnu::always_inline]] inline Outcome step(const Columns& c, std::size_t i, double kn, double ks, const Limits& limits,
                                           const Strength& strength, const Creep& creep = Creep()) {
    const double area = c.area[i], old_gap = c.gaps[i], old_normal = c.normal_force[i];
    const double per_area = area > 0 ? 1 / area : 0;

    // Normal: the spring acts on the displacement beyond the gap (1), up to the tensile limit (2). A failed joint without tension
    // separates: beyond a gap of 0 its sides are out of contact.
    const double contact_gap = limits.residual_tension > 0 ? INFINITY : 0;
    const double lowest = -limits.residual_tension * area;
    const double held = old_gap > 0 ? lowest : old_normal;
    const double pulled = held - kn * area * (old_gap + c.opening[i]);
    const bool breaks = pulled < -limits.tension * area;
    const double stretched = breaks ? (lowest - pulled) * per_area / kn : 0;
    double new_gap = area > 0 ? stretched : std::max(0.0, old_gap + c.opening[i]);
    const double elastic_normal = breaks ? lowest : pulled;
    const bool apart = new_gap > contact_gap;
    const bool parts = breaks && beyond_rounding(new_gap, area);

    // Shear: elastic trial (3), less creep, against the limit (4).
    const double old_x = c.force_x[i], old_y = c.force_y[i], old_z = c.force_z[i];
    const auto [trial_x, trial_y, trial_z] = elastic_shear(c, i, ks);
    const double elastic = length({trial_x, trial_y, trial_z});
    const double trial = creep.relaxed(elastic);
    const double excess = apart ? 0 : std::max(0.0, trial - strength.at(elastic_normal));

    const double divisor = std::max(elastic, std::numeric_limits<double>::min());
    double new_normal = elastic_normal, normal_of_limit = elastic_normal, climbed = 0;
    if constexpr (dilates) {
        // Dilation changes the normal force and with it the limit: slip that brings trial and limit together (5), by Newton's method, which
        // is exact where the opening changes evenly; the remaining slip follows at the new limit (6). Where reverse slip reduces the
        // strength faster than the spring force, the two do not meet: the step then slips up to the limit at its start, and the next steps
        // continue.
        const auto climb = Climb::of(c, i, {-trial_x / divisor, -trial_y / divisor, -trial_z / divisor},
                                     limits.dilatancy, limits.last_dilation);
        const double stiffness = kn * strength.slope(elastic_normal);
        const bool meet = climb.slope(0) * stiffness > -0.9 * ks;
        const double alone = excess * per_area / ks;
        double both = alone;
#pragma GCC unroll 3
        for (int pass = 0; pass < 3; ++pass) {
            const double over = excess * per_area - ks * both - stiffness * climb.change(both);
            const double next = both + over / std::max(ks + stiffness * climb.slope(both), 0.1 * ks);
            const double end = meet ? trial * per_area / ks : alone; // no strength is below 0
            both = std::min(std::max(meet ? 0 : alone, next), end);
        }
        climbed = excess > 0 ? climb.change(both) : 0;
        // Sides that close by reverse slip without normal stress separate.
        const double pressed = elastic_normal + kn * area * climbed, floor = std::min(lowest, elastic_normal);
        const double lost = std::max(0.0, floor - pressed) * per_area / kn;
        new_normal = std::max(pressed, floor);
        normal_of_limit = meet ? new_normal : elastic_normal;
        new_gap += lost;
        c.dilated[i] += climbed;
        climbed += lost;
    }
    const double most = apart ? 0 : strength.at(normal_of_limit);
    const double limit = std::min(trial, most);
    const double slipped = (elastic - limit) * per_area / ks;
    const double scale = limit / divisor; // exactly 1 where it neither yields nor creeps
    if constexpr (dilates) {
        const double part = excess > 0 ? (trial - limit) * per_area / ks / divisor : 0;
        c.travel_x[i] -= part * trial_x;
        c.travel_y[i] -= part * trial_y;
        c.travel_z[i] -= part * trial_z;
    }

    // Work taken up: mean force times slip, less the work of dilation (7), which is negative in reverse slip; and the energy of a bond that
    // breaks in tension.
    const double along_old = (old_x * trial_x + old_y * trial_y + old_z * trial_z) / divisor;
    const double sheared = 0.5 * (along_old + limit) * slipped;
    const double lifted = 0.5 * (old_normal + new_normal) * climbed;
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
                  (parts ? tension_now : 0);
    return {apart ? 0 : slipped, excess};
}

// --- the frame of a model -------------------------------------------------------------------------------------------------

/// Distance between the sides of a new row.
inline double gap_between(const kaya_jbatch& batch, std::size_t i) {
    return beyond_rounding(batch.normal_disp[i], batch.area[i]) ? batch.normal_disp[i] : 0;
}

/// New rows: open sides have a gap, and no bond that could pull them together.
inline ptrdiff_t initialise(kaya_jbatch* batch) {
    double* gaps = batch->history[gap];
    for (std::size_t i = 0; i < batch->n; ++i) {
        batch->normal_stiffness[i] = batch->properties[stiffness_normal];
        batch->shear_stiffness[i] = batch->properties[stiffness_shear];
        const double apart = gap_between(*batch, i);
        const bool loaded = batch->normal_force[i] != 0;
        const double opened = gaps[i] > 0 ? gaps[i] : apart;
        gaps[i] = loaded ? 0 : opened;
        if (!loaded && beyond_rounding(opened, batch->area[i])) batch->state[i] |= tension_past;
    }
    return -1;
}

/// The same for a model that shows its present angle of friction: it begins with the one at rest.
template <std::size_t current> ptrdiff_t initialise_with_angle(kaya_jbatch* batch) {
    initialise(batch);
    double* angle = batch->history[current];
    for (std::size_t i = 0; i < batch->n; ++i)
        if (angle[i] == 0) angle[i] = batch->properties[friction];
    return -1;
}

inline void max_stiffness(const double* p, double* normal, double* shear) {
    *normal = p[stiffness_normal];
    *shear = p[stiffness_shear];
}

/// A model of the family: its tables begin with the shared rows.
template <std::size_t property_rows, std::size_t history_rows>
constexpr kaya_jmodel model(const char* name, const char* title,
                            const std::array<kaya_jproperty, property_rows>& its_properties,
                            const std::array<kaya_jhistory, history_rows>& its_history, ptrdiff_t (*run)(kaya_jbatch*),
                            const char* (*check_values)(const double*) = check,
                            ptrdiff_t (*begin)(kaya_jbatch*) = initialise) {
    return {KAYA_JMODEL_INTERFACE, sizeof(kaya_jmodel), name,         title,       "1.0", its_properties.data(),
            property_rows,         its_history.data(),  history_rows, state_names, begin, run,
            check_values,          max_stiffness};
}

} // namespace kaya::joints::coulomb
