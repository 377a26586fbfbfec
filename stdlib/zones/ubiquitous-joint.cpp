// Zone model `ubiquitous-joint`: Mohr-Coulomb rock with one direction of weakness everywhere.
// docs/zone-models/ubiquitous-joint.md has the equations, (n) below are their numbers.
#include "stdlib/zones/mohr_coulomb.hpp"
#include "stdlib/zones/principal.hpp"
#include "stdlib/zones/turning.hpp"

namespace {

using namespace kaya::zones;

enum Property : std::size_t {
    cohesion = moduli_count,
    friction,
    dilation,
    tension,
    joint_cohesion,
    joint_friction,
    joint_dilation,
    joint_tension,
    dip,
    dip_direction
};
constexpr std::array properties{
    bulk_property,
    shear_property,
    kaya_zproperty{"cohesion", "bcohesion", "stress", "cohesion of the rock", 0, 0, INFINITY, 0, KAYA_ZREDUCE_DIVIDE},
    kaya_zproperty{"friction", "bfriction", "angle", "angle of internal friction of the rock", 0, 0, 89.9, 0,
                   KAYA_ZREDUCE_TANGENT},
    kaya_zproperty{"dilation", "bdilation", "angle", "angle of dilation of the rock", 0, 0, 89.9, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"tension", "btension", "stress", "tensile strength of the rock", 0, 0, INFINITY, 0,
                   KAYA_ZREDUCE_DIVIDE},
    kaya_zproperty{"joint-cohesion", "jcohesion", "stress", "cohesion of the weak planes", 0, 0, INFINITY, 0,
                   KAYA_ZREDUCE_DIVIDE},
    kaya_zproperty{"joint-friction", "jfriction", "angle", "friction of the weak planes", 0, 0, 89.9, 0,
                   KAYA_ZREDUCE_TANGENT},
    kaya_zproperty{"joint-dilation", "jdilation", "angle", "dilation of the weak planes", 0, 0, 89.9, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"joint-tension", "jtension", "stress", "tensile strength across the weak planes", 0, 0, INFINITY, 0,
                   KAYA_ZREDUCE_DIVIDE},
    kaya_zproperty{"dip", "", "angle", "dip of the weak planes", 0, 0, 90, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"dip-direction", "dd", "angle", "dip direction of the weak planes, clockwise from y", 0, 0, 360, 0,
                   KAYA_ZREDUCE_NONE},
};

enum History : std::size_t { plastic_shear, plastic_tension, joint_shear, turn };
constexpr std::array<kaya_jhistory, 7> history{{
    {"plastic-shear", "-", "plastic shear strain of the rock so far"},
    {"plastic-tension", "-", "plastic strain by the tension cut-off of the rock so far"},
    {"joint-shear", "-", "plastic shear strain along the weak planes so far"},
    turn_history[0],
    turn_history[1],
    turn_history[2],
    turn_history[3],
}};

constexpr const char* states =
    "shear-now tension-now shear-past tension-past joint-shear-now joint-tension-now joint-shear-past joint-tension-past";
constexpr int joint_bits = 4;

/// The weak planes and their strength.
struct Weakness {
    Vector3 normal;
    double cohesion, tangent, dilatancy, tension;

    explicit Weakness(const double* p) {
        normal = plane_normal(p[dip], p[dip_direction]);
        cohesion = p[joint_cohesion];
        tangent = std::tan(p[joint_friction] * radians);
        dilatancy = std::min(tangent, std::tan(p[joint_dilation] * radians));
        tension = tangent > 0 ? std::min(p[joint_tension], cohesion / tangent) : p[joint_tension];
    }
};

/// Returns the traction on the weak planes to their strength (2), (3). Returns the bits of the state.
std::uint32_t yield_on(const Weakness& weak, const Moduli& moduli, Tensor& stress, double& slipped,
                       double& dissipated) {
    const Vector3& n = weak.normal;
    const Vector3 traction{stress[0] * n[0] + stress[3] * n[1] + stress[4] * n[2],
                           stress[3] * n[0] + stress[1] * n[1] + stress[5] * n[2],
                           stress[4] * n[0] + stress[5] * n[1] + stress[2] * n[2]};
    const double across = dot(traction, n);
    Vector3 along{traction[0] - across * n[0], traction[1] - across * n[1], traction[2] - across * n[2]};
    const double tau = std::sqrt(dot(along, along));
    if (tau > 0)
        for (double& component : along) component /= tau;
    const double stiff = moduli.bulk + 4.0 / 3.0 * moduli.shear, lame = moduli.lame();
    double less_tau = 0, opening = 0; // reduction of the shear stress by flow, and strain across the planes
    std::uint32_t state = 0;
    if (const double excess = tau + weak.tangent * across - weak.cohesion; excess > 0) {
        const double amount = excess / (moduli.shear + stiff * weak.tangent * weak.dilatancy);
        less_tau = moduli.shear * amount;
        opening = weak.dilatancy * amount;
        state |= shear_now;
    }
    if (across - stiff * opening > weak.tension || less_tau > tau) {
        opening = std::max(0.0, across - weak.tension) / stiff;
        const double bearable = std::max(0.0, weak.cohesion - weak.tangent * (across - stiff * opening));
        less_tau = std::max(0.0, tau - bearable);
        state = tension_now | (less_tau > 0 ? shear_now : 0u);
    }
    if (state == 0) return 0;
    slipped += less_tau / (2 * moduli.shear);
    dissipated += (tau - less_tau) * less_tau / moduli.shear + (across - stiff * opening) * opening;
    constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int c = 0; c < 6; ++c) {
        const int i = row[c], j = column[c];
        const double one = i == j ? 1 : 0;
        stress[c] -=
            less_tau * (n[i] * along[j] + along[i] * n[j]) + opening * (lame * one + (stiff - lame) * n[i] * n[j]);
    }
    return state;
}

ptrdiff_t run(kaya_zbatch* batch) {
    const double* p = batch->properties;
    const Moduli moduli{p[0], p[1]};
    const Strength strength = Strength::of(p[cohesion], p[friction], std::min(p[dilation], p[friction]), p[tension]);
    Weakness weak(p);
    add_elastic(*batch, moduli);
    // Marks the flow of the step before as past, in the rock and on the planes.
    for (std::size_t i = 0; i < batch->n; ++i)
        batch->state[i] = state_after(batch->state[i] & 15u, false, false) |
                          state_after(batch->state[i] >> joint_bits, false, false) << joint_bits;
    const auto holds = [&](std::size_t, double high, double low) { return strength.holds(high, low); };
    for_rows_that_may_yield(*batch, holds, [&](std::size_t i, Principal& principal) {
        const Flow flow = return_to(strength, moduli, principal.value);
        if (!flow.shear && !flow.tension) return;
        put_stress(*batch, i, principal.tensor());
        batch->dissipation[i] = dot(principal.value, flow.strain);
        batch->history[plastic_shear][i] += shear_measure(flow.strain);
        batch->history[plastic_tension][i] += flow.along_tension;
        batch->state[i] |= bits_of(flow);
    });
    const Vector3 normal = weak.normal;
    for (std::size_t i = 0; i < batch->n; ++i) {
        Tensor stress = stress_of(*batch, i);
        weak.normal = turned(*batch, turn, i, normal);
        const std::uint32_t on_planes =
            yield_on(weak, moduli, stress, batch->history[joint_shear][i], batch->dissipation[i]);
        if (on_planes == 0) continue;
        put_stress(*batch, i, stress);
        batch->state[i] |= on_planes << joint_bits;
    }
    return -1;
}

const char* check(const double* p) {
    if (p[dilation] > p[friction])
        return "the dilation is above the friction: rock would create energy; give a smaller dilation";
    if (p[joint_dilation] > p[joint_friction])
        return "joint-dilation is above joint-friction: the planes would create energy; give a smaller one";
    return nullptr;
}

constexpr kaya_zmodel descriptor = model("ubiquitous-joint", "Mohr-Coulomb plasticity with planes of weakness",
                                         properties, history, states, true, run, check);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
