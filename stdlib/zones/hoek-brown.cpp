// Zone model `hoek-brown`: the generalised criterion, with a constant angle of dilation.
// docs/zone-models/hoek-brown.md has the equations, (n) below are their numbers.
#include "stdlib/zones/mohr_coulomb.hpp"
#include "stdlib/zones/principal.hpp"

#include <cstdio>

namespace {

using namespace kaya::zones;

enum Property : std::size_t { constant_sci = moduli_count, constant_mb, constant_s, constant_a, dilation };
constexpr std::array properties{
    bulk_property,
    shear_property,
    kaya_zproperty{"constant-sci", "sigci hbs_ci", "stress", "uniaxial strength of intact rock", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"constant-mb", "mb hb_m", "-", "m_b of the rock mass", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"constant-s", "hb_s", "-", "s of the rock mass", NAN, 0, 1, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"constant-a", "hb_a", "-", "exponent of the rock mass", 0.5, 0.1, 1, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"dilation", "bdilation", "angle", "angle of dilation", 0, 0, 89.9, 0, KAYA_ZREDUCE_NONE},
};

enum History : std::size_t { plastic_shear, plastic_tension };
constexpr std::array<kaya_jhistory, 2> history{{
    {"plastic-shear", "-", "plastic shear strain so far"},
    {"plastic-tension", "-", "plastic strain by the tension cut-off so far"},
}};

/// The curve in compression-positive stresses: s1 = s3 + sci (mb s3/sci + s)^a (1).
struct Curve {
    double sci, mb, s, a;

    double tip() const { return -s * sci / mb; }
    bool holds(double greatest_tension, double least_tension) const {
        return -greatest_tension >= tip() && -least_tension <= greatest(std::max(-greatest_tension, tip()));
    }
    double greatest(double s3) const { return s3 + sci * std::pow(std::max(0.0, mb * s3 / sci + s), a); }
    double slope(double s3) const { return 1 + a * mb * std::pow(std::max(1e-12, mb * s3 / sci + s), a - 1); }
};

/// The tangent plane at s3 as a surface of Mohr and Coulomb.
Strength tangent(const Curve& curve, double s3, double flow) {
    const double k = curve.slope(s3);
    return {k, curve.greatest(s3) - k * s3, flow, -curve.tip()};
}

ptrdiff_t run(kaya_zbatch* batch) {
    const double* p = batch->properties;
    const Moduli moduli{p[0], p[1]};
    const Curve curve{p[constant_sci], p[constant_mb], p[constant_s], p[constant_a]};
    const double flow_slope = Strength::slope_of(p[dilation]);
    add_elastic(*batch, moduli);
    forget_flow(*batch);
    // In compression positive: s1 = -low, s3 = -high. The curve rises with s3.
    const auto holds = [&](std::size_t i, double high, double low) {
        batch->row = i;
        return curve.holds(high, low);
    };
    for_rows_that_may_yield(*batch, holds, [&](std::size_t i, Principal& principal) {
        batch->row = i;
        const Vector3 trial = principal.value;
        if (curve.holds(trial[0], trial[2])) return;
        // The curve is convex in s3: tangents at the answers so far close in on it from outside (2).
        Flow flow;
        double at = std::max(-trial[0], curve.tip());
        constexpr int most = 50;
        for (int k = 0; k < most; ++k) {
            principal.value = trial;
            flow = return_to(tangent(curve, at, flow_slope), moduli, principal.value);
            const double found = std::max(-principal.value[0], curve.tip());
            const double way = std::abs(found - at);
            at = found;
            if (way <= 1e-12 * curve.sci) break;
        }
        put_stress(*batch, i, principal.tensor());
        batch->dissipation[i] = dot(principal.value, flow.strain);
        batch->history[plastic_shear][i] += shear_measure(flow.strain);
        batch->history[plastic_tension][i] += flow.along_tension;
        batch->state[i] |= bits_of(flow);
    });
    return -1;
}

const char* check(const double* p) {
    if (!(p[constant_sci] > 0)) return "constant-sci must be above 0";
    if (!(p[constant_mb] > 0)) return "constant-mb must be above 0";
    return nullptr;
}

constexpr kaya_zmodel descriptor = model("hoek-brown", "generalised Hoek-Brown plasticity", properties, history, states_of_flow, true,
                                         run, check);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
