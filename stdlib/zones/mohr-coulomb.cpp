// Zone model `mohr-coulomb`: perfectly plastic, with a tension cut-off and dilation.
// docs/zone-models/mohr-coulomb.md has the equations.
#include "stdlib/zones/mohr_coulomb.hpp"
#include "stdlib/zones/principal.hpp"

namespace {

using namespace kaya::zones;

enum Property : std::size_t { cohesion = moduli_count, friction, dilation, tension };
constexpr std::array properties{
    bulk_property,
    shear_property,
    kaya_zproperty{"cohesion", "bcohesion", "stress", "cohesion", 0, 0, INFINITY, 0, KAYA_ZREDUCE_DIVIDE},
    kaya_zproperty{"friction", "bfriction", "angle", "angle of internal friction", 0, 0, 89.9, 0, KAYA_ZREDUCE_TANGENT},
    kaya_zproperty{"dilation", "bdilation", "angle", "angle of dilation", 0, 0, 89.9, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"tension", "btension", "stress", "tensile strength", 0, 0, INFINITY, 0, KAYA_ZREDUCE_DIVIDE},
};

enum History : std::size_t { plastic_shear, plastic_tension };
constexpr std::array<kaya_jhistory, 2> history{{
    {"plastic-shear", "-", "plastic shear strain so far"},
    {"plastic-tension", "-", "plastic strain by the tension cut-off so far"},
}};

ptrdiff_t run(kaya_zbatch* batch) {
    const double* p = batch->properties;
    const Moduli moduli{p[0], p[1]};
    const Strength strength = Strength::of(p[cohesion], p[friction], std::min(p[dilation], p[friction]), p[tension]);
    add_elastic(*batch, moduli);
    forget_flow(*batch);
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
    return -1;
}

const char* check(const double* p) {
    if (p[dilation] > p[friction])
        return "the dilation is above the friction: rock would create energy; give a smaller dilation";
    return nullptr;
}

constexpr kaya_zmodel descriptor = model("mohr-coulomb", "Mohr-Coulomb plasticity with a tension cut-off", properties,
                                         history, states_of_flow, true, run, check);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
