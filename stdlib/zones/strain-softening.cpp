// Zone model `strain-softening`: Mohr-Coulomb whose strength follows tables of plastic strain.
// docs/zone-models/strain-softening.md has the equations.
#include "stdlib/zones/mohr_coulomb.hpp"
#include "stdlib/zones/principal.hpp"

#include <cstdio>

namespace {

using namespace kaya::zones;

enum Property : std::size_t {
    cohesion = moduli_count,
    friction,
    dilation,
    tension,
    cohesion_table,
    friction_table,
    dilation_table,
    tension_table,
    length_reference
};
constexpr std::array properties{
    bulk_property,
    shear_property,
    kaya_zproperty{"cohesion", "bcohesion", "stress", "cohesion where there is no table", 0, 0, INFINITY, 0,
                   KAYA_ZREDUCE_DIVIDE},
    kaya_zproperty{"friction", "bfriction", "angle", "angle of internal friction where there is no table", 0, 0, 89.9,
                   0, KAYA_ZREDUCE_TANGENT},
    kaya_zproperty{"dilation", "bdilation", "angle", "angle of dilation where there is no table", 0, 0, 89.9, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"tension", "btension", "stress", "tensile strength where there is no table", 0, 0, INFINITY, 0,
                   KAYA_ZREDUCE_DIVIDE},
    kaya_zproperty{"table-cohesion", "ctable", "-",
                   "number of the table of cohesion over plastic shear strain; 0: none", 0, 0, 2147483647, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"table-friction", "ftable", "-",
                   "number of the table of friction over plastic shear strain; 0: none", 0, 0, 2147483647, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"table-dilation", "dtable", "-",
                   "number of the table of dilation over plastic shear strain; 0: none", 0, 0, 2147483647, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"table-tension", "ttable", "-",
                   "number of the table of tensile strength over plastic tensile strain; 0: none", 0, 0, 2147483647, 0,
                   KAYA_ZREDUCE_NONE},
    kaya_zproperty{"length-reference", "", "length", "size of zone for which the tables hold; 0: any", 0, 0, INFINITY,
                   0, KAYA_ZREDUCE_NONE},
};

enum History : std::size_t { plastic_shear, plastic_tension };
constexpr std::array<kaya_jhistory, 2> history{{
    {"plastic-shear", "-", "plastic shear strain so far"},
    {"plastic-tension", "-", "plastic strain by the tension cut-off so far"},
}};

/// A property that a table gives, or a number.
struct Curve {
    const kaya_jtables* tables = nullptr;
    const void* table = nullptr;
    double value = 0;

    double at(double strain) const { return table ? tables->value(table, strain) : value; }
};

/// False after writing the message about a missing table.
bool take(Curve& curve, kaya_zbatch* batch, std::size_t value, std::size_t table) {
    curve.value = batch->properties[value];
    if (batch->properties[table] == 0) return true;
    char name[32];
    std::snprintf(name, sizeof name, "%.0f", batch->properties[table]);
    curve.tables = batch->tables;
    curve.table = batch->tables ? batch->tables->find(batch->tables, name) : nullptr;
    if (curve.table) return true;
    std::snprintf(batch->message, sizeof batch->message, "there is no table %s, which %s names", name,
                  properties[table].name);
    return false;
}

ptrdiff_t run(kaya_zbatch* batch) {
    const double* p = batch->properties;
    const Moduli moduli{p[0], p[1]};
    Curve c, phi, psi, t;
    if (!take(c, batch, cohesion, cohesion_table) || !take(phi, batch, friction, friction_table) ||
        !take(psi, batch, dilation, dilation_table) || !take(t, batch, tension, tension_table))
        return 0;
    double* sheared = batch->history[plastic_shear];
    double* opened = batch->history[plastic_tension];
    const auto strength_of = [&](std::size_t i) {
        batch->row = i;
        // Strain gathers in one layer of zones: the thinner they are the more of it for the same displacement (2).
        const double scale = p[length_reference] > 0 ? std::cbrt(batch->volume[i]) / p[length_reference] : 1;
        const double friction_now = phi.at(scale * sheared[i]),
                     dilation_now = std::min(psi.at(scale * sheared[i]), friction_now);
        return Strength::of(std::max(0.0, c.at(scale * sheared[i])), friction_now, dilation_now,
                            std::max(0.0, t.at(scale * opened[i])));
    };
    add_elastic(*batch, moduli);
    forget_flow(*batch);
    const auto holds = [&](std::size_t i, double high, double low) { return strength_of(i).holds(high, low); };
    for_rows_that_may_yield(*batch, holds, [&](std::size_t i, Principal& principal) {
        const Flow flow = return_to(strength_of(i), moduli, principal.value);
        if (!flow.shear && !flow.tension) return;
        put_stress(*batch, i, principal.tensor());
        batch->dissipation[i] = dot(principal.value, flow.strain);
        sheared[i] += shear_measure(flow.strain);
        opened[i] += flow.along_tension;
        batch->state[i] |= bits_of(flow);
    });
    return -1;
}

constexpr kaya_zmodel descriptor = model("strain-softening", "Mohr-Coulomb that softens or hardens with plastic strain",
                                         properties, history, states_of_flow, true, run);

} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
