// Zone model `drucker-prager`: a cone in stress space with a tension cut-off; von Mises with q-friction 0.
// docs/zone-models/drucker-prager.md has the equations, (n) below are their numbers.
#include "stdlib/zones/mohr_coulomb.hpp"

namespace {

using namespace kaya::zones;

enum Property : std::size_t { k_shear = moduli_count, q_friction, q_dilation, tension };
constexpr std::array properties{
    bulk_property,
    shear_property,
    kaya_zproperty{"cohesion-drucker", "kshear", "stress", "k of the cone", 0, 0, INFINITY, 0, KAYA_ZREDUCE_DIVIDE},
    kaya_zproperty{"friction-drucker", "qfric", "-", "slope of the cone", 0, 0, INFINITY, 0, KAYA_ZREDUCE_DIVIDE},
    kaya_zproperty{"dilation-drucker", "qdil", "-", "slope of the flow", 0, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    kaya_zproperty{"tension", "btension", "stress", "greatest mean stress", 0, 0, INFINITY, 0, KAYA_ZREDUCE_DIVIDE},
};

enum History : std::size_t { plastic_shear, plastic_tension };
constexpr std::array<kaya_jhistory, 2> history{{
    {"plastic-shear", "-", "plastic shear strain so far"},
    {"plastic-tension", "-", "plastic strain by the tension cut-off so far"},
}};

ptrdiff_t run(kaya_zbatch* batch) {
    const double* p = batch->properties;
    const Moduli moduli{p[0], p[1]};
    const double k = p[k_shear], q = p[q_friction], flow = std::min(p[q_dilation], q);
    const double cut = q > 0 ? std::min(p[tension], k / q) : p[tension];
    for (std::size_t i = 0; i < batch->n; ++i) {
        Tensor stress = stress_of(*batch, i);
        moduli.add(stress, strain_of(*batch, i));
        const double mean_trial = (stress[0] + stress[1] + stress[2]) / 3;
        Tensor deviator = stress;
        for (int c = 0; c < 3; ++c) deviator[c] -= mean_trial;
        double squares = 0;
        for (int c = 0; c < 6; ++c) squares += (c < 3 ? 0.5 : 1.0) * deviator[c] * deviator[c];
        const double tau_trial = std::sqrt(squares);
        double mean = mean_trial, tau = tau_trial;
        bool shear = false, opens = false;
        if (const double excess = tau + q * mean - k; excess > 0) { // (2)
            const double amount = excess / (moduli.shear + moduli.bulk * q * flow);
            tau -= moduli.shear * amount;
            mean -= moduli.bulk * flow * amount;
            shear = true;
        }
        if (mean > cut || tau < 0) { // (3): on the rim of the cone, or below it on the cut-off
            mean = std::min(mean, cut);
            if (tau < 0) mean = std::min(cut, mean_trial);
            tau = std::min(tau_trial, std::max(0.0, k - q * mean));
            opens = true;
            shear = tau < tau_trial;
        }
        if (shear || opens) {
            const double scale = tau_trial > 0 ? tau / tau_trial : 0;
            for (int c = 0; c < 6; ++c) stress[c] = scale * deviator[c] + (c < 3 ? mean : 0);
            const double sheared = (tau_trial - tau) / moduli.shear / 2, opened = (mean_trial - mean) / moduli.bulk;
            batch->history[plastic_shear][i] += sheared;
            if (opens) batch->history[plastic_tension][i] += opened;
            batch->dissipation[i] = 2 * tau * sheared + mean * opened;
        }
        batch->state[i] = state_after(batch->state[i], shear, opens);
        put_stress(*batch, i, stress);
    }
    return -1;
}

const char* check(const double* p) {
    if (p[q_dilation] > p[q_friction])
        return "dilation-drucker is above friction-drucker: rock would create energy; give a smaller one";
    return nullptr;
}

constexpr kaya_zmodel descriptor = model("drucker-prager", "Drucker-Prager plasticity with a tension cut-off",
                                         properties, history, states_of_flow, true, run, check);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
