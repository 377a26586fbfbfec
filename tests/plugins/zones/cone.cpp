// Drucker-Prager's cone (Drucker and Prager 1952), written from kaya/zmodel.h and docs/writing-a-zone-model.md alone: sqrt(J2) + q p = k
// with the mean stress p, tension positive; flow with the slope `dilation`, and return to the apex from beyond it.
#include "kaya/zmodel.h"

#include <cmath>

namespace {

enum Property : std::size_t { bulk, shear, strength, slope, dilation, count };
constexpr kaya_zproperty properties[count] = {
    {"bulk", "k", "stress", "bulk modulus", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    {"shear", "g", "stress", "shear modulus", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    {"strength", "", "stress", "k of the cone", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_DIVIDE},
    {"slope", "", "-", "q of the cone", NAN, 1e-9, INFINITY, 0, KAYA_ZREDUCE_DIVIDE},
    {"dilation", "", "-", "slope of the flow", 0, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
};

ptrdiff_t run(kaya_zbatch* b) {
    const double *v = b->properties, k = v[strength], q = v[slope], flow = v[dilation];
    for (std::size_t i = 0; i < b->n; ++i) {
        double deviator[6], volume = 0, mean = 0, squares = 0;
        for (int c = 0; c < 3; ++c) {
            volume += b->strain_inc[c][i];
            mean += b->stress[c][i] / 3;
        }
        for (int c = 0; c < 6; ++c) {
            const double strain = b->strain_inc[c][i] - (c < 3 ? volume / 3 : 0);
            deviator[c] = b->stress[c][i] - (c < 3 ? mean : 0) + 2 * v[shear] * strain;
            squares += (c < 3 ? 0.5 : 1.0) * deviator[c] * deviator[c];
        }
        mean += v[bulk] * volume;
        const double trial = std::sqrt(squares), mean_trial = mean, beyond = trial + q * mean - k;
        double tau = trial;
        if (beyond > 0) {
            const double amount = beyond / (v[shear] + v[bulk] * q * flow);
            tau -= v[shear] * amount;
            mean -= v[bulk] * flow * amount;
            if (tau < 0) tau = 0, mean = k / q; // the tip
            b->dissipation[i] = tau * (trial - tau) / v[shear] + mean * (mean_trial - mean) / v[bulk];
        }
        b->state[i] = beyond > 0;
        const double scale = trial > 0 ? tau / trial : 0;
        for (int c = 0; c < 6; ++c) b->stress[c][i] = scale * deviator[c] + (c < 3 ? mean : 0);
    }
    return -1;
}

const char* check(const double* v) {
    return v[dilation] <= v[slope] ? nullptr : "dilation is above slope: flow would make energy; give a smaller one";
}
void moduli(const double* v, double* k, double* g) { *k = v[bulk], *g = v[shear]; }

constexpr kaya_zmodel descriptor = {KAYA_ZMODEL_INTERFACE,
                                    sizeof(kaya_zmodel),
                                    "cone",
                                    "Drucker-Prager's cone",
                                    "1.0",
                                    properties,
                                    count,
                                    nullptr,
                                    0,
                                    "yields",
                                    1,
                                    run,
                                    check,
                                    moduli};

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
