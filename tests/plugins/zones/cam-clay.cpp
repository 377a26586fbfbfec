// Modified Cam-clay (Roscoe and Burland 1968), written from kaya/zmodel.h and docs/writing-a-zone-model.md alone. Volume strains are
// logarithmic: ln p decreases by lambda or kappa per unit. Internal signs: pressure p and its plastic volume strain x in compression. Yield
// surface q^2/M^2 + p (p - pc) = 0, associated flow, pc increases by dx/(lambda - kappa).
#include "kaya/zmodel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

enum Property : std::size_t { bulk, shear, slope, lambda, kappa, start };
constexpr kaya_zproperty properties[] = {
    {"bulk", "k", "stress", "greatest bulk modulus that is allowed", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    {"shear", "g", "stress", "shear modulus", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    {"critical-slope", "m", "-", "q/p in the critical state", NAN, 1e-3, 3, 0, KAYA_ZREDUCE_DIVIDE},
    {"lambda", "", "-", "slope of first loading", NAN, 1e-9, 1, 0, KAYA_ZREDUCE_NONE},
    {"kappa", "", "-", "slope of unloading", NAN, 1e-9, 1, 0, KAYA_ZREDUCE_NONE},
    {"preconsolidation", "pc", "stress", "pressure it has carried", NAN, 1e-30, INFINITY, 0, KAYA_ZREDUCE_NONE},
};
constexpr kaya_jhistory history[] = {{"preconsolidation", "stress", "pressure at the end of the yield surface"}};

/// Return of an elastic trial to the yield surface.
struct Return {
    double p_trial, q_trial, pc_before, m, shear, lambda, kappa;
    double p = p_trial, q = q_trial, pc = pc_before;

    double at(double x) { // negative for too little flow
        p = p_trial * std::exp(-x / kappa);
        pc = pc_before * std::exp(x / (lambda - kappa));
        q = m * std::sqrt(p * std::max(0.0, pc - p));
        return 6 * shear * x * q - m * m * (q_trial - q) * (2 * p - pc);
    }
    double solve() { // between no flow or the end of the surface, and the critical state
        const double per_log = 1 / (1 / kappa + 1 / (lambda - kappa)), ratio = std::log(p_trial / pc_before);
        double low = std::min((ratio + std::log(2.0)) * per_log, 0.0),
               high = std::max(0.0, (ratio + std::log(2.0)) * per_log);
        if (low == 0) low = std::max(0.0, ratio * per_log);
        // q varies with the root of pc - p: as a function of the root of x - low the residual is smooth.
        double from = 0, to = std::sqrt(high - low), at_from = at(low), at_to = at(high), x = low;
        const bool sheared =
            q_trial > 1e-7 * p_trial; // otherwise p is that of the end of the surface to the last digit
        for (int i = 0, last = 0; sheared && i < 100 && at_from * at_to < 0; ++i) { // regula falsi, Illinois variant
            const double root = (from * at_to - to * at_from) / (at_to - at_from);
            x = low + root * root;
            const double here = at(x);
            if (std::abs(here) <= 1e-14 * m * m * q_trial * pc_before) break;
            if (here < 0) at_to *= last == -1 ? 0.5 : 1, from = root, at_from = here, last = -1;
            else at_from *= last == 1 ? 0.5 : 1, to = root, at_to = here, last = 1;
        }
        at(x);
        q = std::min(q, q_trial);
        return x;
    }
};

ptrdiff_t run(kaya_zbatch* b) {
    const double* v = b->properties;
    for (b->row = 0; b->row < b->n; ++b->row) {
        const std::size_t i = b->row;
        double stress[6], mean = 0, volume = 0, squares = 0;
        for (int k = 0; k < 3; ++k) mean += b->stress[k][i] / 3, volume += b->strain_inc[k][i];
        if (!(mean < 0 && -mean / v[kappa] <= v[bulk])) {
            std::snprintf(b->message, sizeof b->message,
                          "a mean stress of %g; it must be below 0, and above %g (bulk times kappa)", mean,
                          -v[bulk] * v[kappa]);
            return static_cast<ptrdiff_t>(i);
        }
        for (int k = 0; k < 6; ++k) {
            stress[k] =
                b->stress[k][i] - (k < 3 ? mean : 0) + 2 * v[shear] * (b->strain_inc[k][i] - (k < 3 ? volume / 3 : 0));
            squares += (k < 3 ? 1.5 : 3.0) * stress[k] * stress[k];
        }
        double& pc = b->history[0][i];
        if (pc == 0) pc = v[start];
        Return zone{
            -mean * std::exp(-volume / v[kappa]), std::sqrt(squares), pc, v[slope], v[shear], v[lambda], v[kappa]};
        const bool yields = squares > v[slope] * v[slope] * zone.p * (pc - zone.p);
        if (yields) {
            const double x = zone.solve(), sheared = (zone.q_trial - zone.q) / (3 * v[shear]);
            pc = zone.pc;
            b->dissipation[i] = zone.p * x + zone.q * sheared;
        }
        b->state[i] = yields;
        const double scale = zone.q_trial > 0 ? zone.q / zone.q_trial : 0;
        for (int k = 0; k < 6; ++k) b->stress[k][i] = scale * stress[k] - (k < 3 ? zone.p : 0);
    }
    return -1;
}

const char* check(const double* v) {
    return v[kappa] < v[lambda] ? nullptr : "kappa must be below lambda; give a smaller one";
}
void moduli(const double* v, double* k, double* g) { *k = v[bulk], *g = v[shear]; }

constexpr kaya_zmodel descriptor = {KAYA_ZMODEL_INTERFACE,
                                    sizeof(kaya_zmodel),
                                    "cam-clay",
                                    "modified Cam-clay",
                                    "1.0",
                                    properties,
                                    6,
                                    history,
                                    1,
                                    "yields",
                                    1,
                                    run,
                                    check,
                                    moduli};

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
