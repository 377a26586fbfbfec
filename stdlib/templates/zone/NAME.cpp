// @NAME@: elastic up to a strength in shear (von Mises), then perfectly plastic. Change it into what you need. kaya/zmodel.h is the manual:
// the columns, their signs, and which members are optional.
#include "kaya/zmodel.h"

#include <cmath>
#include <iterator>

namespace {

// run() gets the values in the order of the table; the enum names them.
enum { bulk, shear, strength, property_count };

constexpr kaya_zproperty properties[] = {
    // name, other words, unit, help, initial value (NAN: must be given), minimum, maximum, may be left out, strength reduction
    {"bulk", "k", "stress", "bulk modulus", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    {"shear", "g", "stress", "shear modulus", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_NONE},
    {"strength", "", "stress", "strength in a uniaxial test", NAN, 0, INFINITY, 0, KAYA_ZREDUCE_DIVIDE},
};
static_assert(std::size(properties) == property_count);

// History of each zone: kept from cycle to cycle, initially 0, and saved.
enum { plastic_shear, history_count };

constexpr kaya_jhistory history[] = {{"plastic-shear", "-", "plastic shear strain so far"}};
static_assert(std::size(history) == history_count);

// Bit 0, bit 1, ... of the column of states.
constexpr const char* state_names = "shear-now shear-past";
constexpr uint32_t shear_now = 1, shear_past = 2;

ptrdiff_t run(kaya_zbatch* batch) {
    const double* p = batch->properties;
    const double K = p[bulk], G = p[shear];
    for (size_t i = 0; i < batch->n; ++i) {
        // The elastic step: xx, yy, zz, xy, xz, yz; tension and extension are positive.
        const double volume = batch->strain_inc[0][i] + batch->strain_inc[1][i] + batch->strain_inc[2][i];
        double s[6], mean = 0;
        for (int k = 0; k < 6; ++k) {
            s[k] = batch->stress[k][i] + 2 * G * batch->strain_inc[k][i];
            if (k < 3) s[k] += (K - 2 * G / 3) * volume;
            if (k < 3) mean += s[k] / 3;
        }
        // Root of 3 J2, which is the strength where the zone flows.
        double second = 0;
        for (int k = 0; k < 6; ++k) second += k < 3 ? 0.5 * (s[k] - mean) * (s[k] - mean) : s[k] * s[k];
        const double q = std::sqrt(3 * second);
        const bool flows = q > p[strength];
        if (flows) {
            const double part = p[strength] / q;
            for (int k = 0; k < 6; ++k) s[k] = k < 3 ? mean + part * (s[k] - mean) : part * s[k];
            const double flow = (q - p[strength]) / (3 * G); // equivalent plastic strain of the step
            batch->history[plastic_shear][i] += flow;
            batch->dissipation[i] = p[strength] * flow; // closes the account of energy
        }
        for (int k = 0; k < 6; ++k) batch->stress[k][i] = s[k];
        batch->state[i] = (batch->state[i] ? shear_past : 0) | (flows ? shear_now : 0);
    }
    return -1; // all rows are well
}

// A sentence when the values cannot work together.
const char* check(const double* p) {
    if (!(p[strength] > 0)) return "strength is 0: give the rock a strength";
    return nullptr;
}

// For the time step: the greatest moduli with which a zone resists.
void moduli(const double* p, double* K, double* G) {
    *K = p[bulk];
    *G = p[shear];
}

constexpr kaya_zmodel model = {
    KAYA_ZMODEL_INTERFACE,
    sizeof(kaya_zmodel),
    "@NAME@",
    "Elastic, perfectly plastic in shear",
    "0.1",
    properties,
    property_count,
    history,
    history_count,
    state_names,
    1, // flows: the model runs at six points of a cell
    run,
    check,
    moduli,
};

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &model; }
