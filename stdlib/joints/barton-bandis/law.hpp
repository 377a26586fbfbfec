// The equations of Barton and Bandis. Numbers like (2.13) are those of docs/joint-models/barton-bandis.md.
//
// All functions are straight lines of arithmetic, so that a loop over rows becomes vector instructions.
#pragma once

#include "kaya/law/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kaya::joints::barton_bandis {

/// Input of the user, in the deck's units.
struct Given {
    double stiffness_normal, stiffness_shear, stiffness_exponent, failure_ratio;
    double residual_friction;
    double jrc_lab, jcs_lab, sigma_c;
    double length_lab, length_field;
    bool unscaled;    ///< JRC and JCS are those of the joint itself
    bool peak_by_lab; ///< L_o instead of L_n in the root of the peak displacement
    double mpa, mm;   ///< 1 MPa in the deck's unit of stress, 1 mm in its unit of length
    bool stepped, hyperbolic, falls, contracts, dilates_by_lab; ///< choices of the thesis, see Law
    double strength_factor = 1;                                 ///< by which the shear strength is divided
};

/// Aperture a_j in mm (2.26).
inline double aperture(const Given& g) { return g.jrc_lab / 5 * (0.2 * g.sigma_c / g.jcs_lab - 0.1); }

/// Maximum closure V_m in mm (2.25), first loading cycle, from the values of the laboratory.
inline double maximum_closure(const Given& g) {
    return -0.2960 - 0.0056 * g.jrc_lab + 2.2410 * std::pow(g.jcs_lab / g.mpa / aperture(g), -0.2450);
}

/// Constants of one property set, in the deck's units; angles in degrees.
struct Law {
    double initial_stiffness, maximum_closure;
    double knee_closure, knee_stress, knee_stiffness; ///< beyond it the closure curve is straight
    double shear_stiffness, stiffness_exponent, per_mpa, half_failure_ratio;
    double residual_friction, jrc, jcs, roughest, lowest_stress;
    double part; ///< of the shear strength that is left
    double peak_displacement, per_peak, radians_per_degree_and_peak;
    // Options of Koçal's listing, which this model uses only on request.
    bool stepped;         ///< B of Table 2.2 is held from each row to the next
    bool hyperbolic;      ///< the stress climbs with (2.28) and not along the mobilised curve
    bool falls;           ///< the strength is the residual one after the first slip
    bool contracts;       ///< negative JRC_mob closes the joint
    double more_dilation; ///< degrees that JCS_o in place of JCS_n adds to RUFF in (2.20)

    bool plain() const { return !(stepped || hyperbolic || falls || contracts || more_dilation != 0); }

    explicit Law(const Given& g) {
        constexpr double knee = 0.98;       // of V_m
        constexpr double largest_peak = 70; // degrees; Barton's limit of the peak friction angle
        initial_stiffness = g.stiffness_normal;
        maximum_closure = barton_bandis::maximum_closure(g) * g.mm;
        knee_closure = knee * maximum_closure;
        knee_stress = initial_stiffness * knee_closure / (1 - knee);
        knee_stiffness = initial_stiffness / ((1 - knee) * (1 - knee));

        const double size = g.unscaled ? 1 : g.length_field / g.length_lab;
        jrc = g.jrc_lab * std::pow(size, -0.02 * g.jrc_lab); // (2.14)
        jcs = g.jcs_lab * std::pow(size, -0.03 * g.jrc_lab); // (2.13)
        residual_friction = g.residual_friction;
        roughest = std::max(0.0, largest_peak - residual_friction);
        part = 1 / g.strength_factor;
        lowest_stress = 1e-12 * jcs; // keeps logarithms and quotients finite while the joint is open

        const double metre = 1000 * g.mm;
        const double root = jrc / ((g.peak_by_lab ? g.length_lab : g.length_field) / metre);
        peak_displacement = g.length_field / 500 * std::pow(root, 0.33); // (2.15)
        shear_stiffness = g.stiffness_shear;
        stiffness_exponent = g.stiffness_exponent;
        per_mpa = 1 / g.mpa;
        half_failure_ratio = 0.5 * g.failure_ratio;
        per_peak = 1 / peak_displacement;
        radians_per_degree_and_peak = std::numbers::pi / 180 / peak_displacement;
        stepped = g.stepped;
        hyperbolic = g.hyperbolic;
        falls = g.falls;
        contracts = g.contracts;
        more_dilation = g.dilates_by_lab ? jrc * std::log10(g.jcs_lab / jcs) : 0;
    }
};

/// Normal stress of a closure (2.22), 0 when open; straight with the tangent of the knee beyond it.
[[gnu::always_inline]] inline double normal_stress(const Law& law, double closure) {
    const double c = std::clamp(closure, 0.0, law.knee_closure);
    return law.initial_stiffness * c / (1 - c / law.maximum_closure) +
           law.knee_stiffness * std::max(0.0, closure - law.knee_closure);
}

/// Its tangent (2.23); while open the tangent at closure 0.
[[gnu::always_inline]] inline double normal_tangent(const Law& law, double closure) {
    const double rest = 1 - std::clamp(closure, 0.0, law.knee_closure) / law.maximum_closure;
    return law.initial_stiffness / (rest * rest);
}

/// The closure that carries a normal stress, which must not be negative.
inline double closure_of_stress(const Law& law, double stress) {
    const double s = std::min(stress, law.knee_stress);
    return s * law.maximum_closure / (law.initial_stiffness * law.maximum_closure + s) +
           std::max(0.0, stress - law.knee_stress) / law.knee_stiffness;
}

/// A straight piece of a curve: from x for `length`, rising by `rise`.
struct Piece {
    double x, length, rise;
};

/// JRC_mob / JRC_n over displacement / peak displacement where it is positive (Table 2.2); from
/// 100 on nothing is left of the roughness. A sum of clamped pieces needs no search.
template <bool in_steps> [[gnu::always_inline]] inline double mobilised_roughness(double x) {
    constexpr Piece pieces[] = {
        {0.30, 0.15, 0.50},  {0.45, 0.15, 0.25},  {0.60, 0.20, 0.15},  {0.80, 0.20, 0.10},
        {1.00, 0.50, -0.10}, {1.50, 0.50, -0.05}, {2.00, 1.00, -0.10}, {3.00, 1.00, -0.05},
        {4.00, 2.00, -0.10}, {6.00, 2.00, -0.05}, {8.00, 2.00, -0.05}, {10.0, 10.0, -0.10},
        {20.0, 20.0, -0.10}, {40.0, 20.0, -0.10}, {60.0, 20.0, -0.10}, {80.0, 20.0, -0.10},
    };
    double sum = 0;
#pragma GCC unroll 16
    for (const auto& p : pieces) {
        if constexpr (in_steps) sum += x >= p.x + p.length ? p.rise : 0;
        else sum += std::clamp(x - p.x, 0.0, p.length) * (p.rise / p.length);
    }
    return std::max(0.0, sum);
}

/// The part of the residual friction angle that is mobilised: the first three rows of Table 2.2, in
/// which B is a multiple of -phi_r/RUFF, so that roughness itself drops out of (2.17).
template <bool in_steps> [[gnu::always_inline]] inline double mobilised_friction(double x) {
    if constexpr (in_steps) return (x >= 0.20 ? 0.75 : 0) + (x >= 0.30 ? 0.25 : 0);
    return 0.75 / 0.20 * std::clamp(x, 0.0, 0.20) + 0.25 / 0.10 * std::clamp(x - 0.20, 0.0, 0.10);
}

/// Mobilised friction and roughness at a displacement.
struct Mobilised {
    double friction, roughness;
};

/// `thesis`: whether the options of Koçal's listing apply; without them the loop over rows is a third shorter.
template <bool thesis> [[gnu::always_inline]] inline Mobilised mobilised_at(const Law& law, double displacement) {
    const double x = displacement * law.per_peak;
    Mobilised m{mobilised_friction<false>(x), mobilised_roughness<false>(x)};
    if constexpr (thesis)
        m = {law.stepped ? mobilised_friction<true>(x) : m.friction,
             law.stepped ? mobilised_roughness<true>(x) : m.roughness};
    return m;
}

/// RUFF (2.18) in degrees: 0 from JCS_n on, and cut where the peak friction angle is 70 degrees.
[[gnu::always_inline]] inline double roughness_angle(const Law& law, double log_stress, double log_jcs) {
    return std::clamp(law.jrc * std::numbers::log10e * (log_jcs - log_stress), 0.0, law.roughest);
}

} // namespace kaya::joints::barton_bandis
