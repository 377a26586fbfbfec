// An elastic zone model that works, but for what KAYA_HARM says: see harm.hpp. What is done in `run` is done from the 40th step of a zone
// on, or with the moment `call` at once.
#include "stdlib/zones/zone.hpp"
#include "tests/plugins/harm.hpp"

#include <limits>

namespace {

using namespace kaya::zones;

const harm::Life life;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();
constexpr std::array properties{bulk_property, shear_property};
constexpr std::array<kaya_jhistory, 1> history{{{"steps", "-", "steps run"}}};

struct Columns {
    const char* name;
    void (*spoil)(kaya_zbatch&);
};

void add(const double* column) { const_cast<double*>(column)[0] += 1e-3; }

// clang-format off
constexpr Columns columns[] = {
    {"volume", [](kaya_zbatch& b) { add(b.volume); }},
    {"strain", [](kaya_zbatch& b) { add(b.strain_inc[4]); }},
    {"pore-pressure", [](kaya_zbatch& b) { add(b.pore_pressure); }},
    {"properties", [](kaya_zbatch& b) { add(b.properties); }},
    {"past-stress", [](kaya_zbatch& b) { b.stress[5][b.n] = 1; }},
    {"past-history", [](kaya_zbatch& b) { b.history[0][b.n] = 1; }},
    {"past-state", [](kaya_zbatch& b) { b.state[b.n] = 1; }},
    {"before-stress", [](kaya_zbatch& b) { b.stress[0][-1] = 1; }},
    {"before-dissipation", [](kaya_zbatch& b) { b.dissipation[-1] = 1; }},
    {"more-rows", [](kaya_zbatch& b) { b.n += 4; }},
    {"other-columns", [](kaya_zbatch& b) { b.stress[0] = b.stress[1]; }},
    {"nan-stress", [](kaya_zbatch& b) { b.stress[3][0] = not_a_number; }},
    {"infinite-stress", [](kaya_zbatch& b) { b.stress[0][b.n - 1] = infinite; }},
    {"nan-history", [](kaya_zbatch& b) { b.history[0][0] = not_a_number; }},
    {"nan-dissipation", [](kaya_zbatch& b) { b.dissipation[0] = not_a_number; }},
    {"huge-stress", [](kaya_zbatch& b) { b.stress[0][0] = 1e300; }},
};
// clang-format on

ptrdiff_t do_harm(const char* moment, kaya_zbatch& batch) {
    harm::at(moment);
    const auto name = harm::chosen(moment);
    for (const Columns& each : columns)
        if (each.name == name) each.spoil(batch);
    if (name == "row-n") return static_cast<ptrdiff_t>(batch.n);
    if (name == "row-negative") return -7;
    return name == "no-reason" ? 0 : -1;
}

ptrdiff_t run(kaya_zbatch* batch) {
    for (size_t i = 0; i < batch->n; ++i) batch->history[0][i] += 1;
    add_elastic(*batch, {batch->properties[0], batch->properties[1]});
    const bool is_late = batch->history[0][0] >= 40;
    const ptrdiff_t row = do_harm("call", *batch);
    return row == -1 && is_late ? do_harm("run", *batch) : row;
}

const char* check(const double*) {
    harm::at("check");
    return nullptr;
}

void moduli(const double* p, double* bulk, double* shear) {
    harm::at("stiffness");
    const auto name = harm::chosen("stiffness");
    *bulk = name == "nan" ? not_a_number : p[0];
    *shear = name == "negative" ? -1 : p[1];
}

} // namespace

const kaya_zmodel* kaya_zone_model(void) {
    static kaya_zmodel table = model("harmful", "does harm", properties, history, "", false, run, check, moduli);
    harm::at("describe");
    const auto name = harm::chosen("describe");
    if (name == "null-table") return nullptr;
    if (name == "null-name") table.name = nullptr;
    if (name == "control-name") table.name = "harm\033[31mful";
    if (name == "null-run") table.run = nullptr;
    if (name == "null-moduli") table.moduli = nullptr;
    if (name == "interface-99") table.interface_version = 99;
    if (name == "size-8") table.size = 8;
    if (name == "endless-properties") table.property_count = ~std::size_t{0};
    if (name == "null-history") table.history = nullptr;
    return &table;
}
