// A joint model that works, but for what KAYA_HARM says: see harm.hpp. What is done in `run` is done from the 40th step of a row on, or
// with the moment `call` at once.
#include "tests/plugins/harm.hpp"
#include "tests/plugins/plugin.hpp"

#include <limits>

namespace {

const harm::Life life;

struct Columns {
    const char* name;
    void (*spoil)(kaya_jbatch&);
};

void twice(const double* column) { const_cast<double*>(column)[0] *= 2; }
void add(const double* column) { const_cast<double*>(column)[0] += 1e-3; }
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

// clang-format off
constexpr Columns columns[] = {
    {"area", [](kaya_jbatch& b) { add(b.area); }},
    {"last-area", [](kaya_jbatch& b) { twice(b.area + b.n - 1); }},
    {"normal-disp", [](kaya_jbatch& b) { add(b.normal_disp); }},
    {"normal-disp-inc", [](kaya_jbatch& b) { add(b.normal_disp_inc); }},
    {"shear-disp", [](kaya_jbatch& b) { add(b.shear_disp[1]); }},
    {"shear-disp-inc", [](kaya_jbatch& b) { add(b.shear_disp_inc[2]); }},
    {"pore-pressure", [](kaya_jbatch& b) { add(b.pore_pressure); }},
    {"properties", [](kaya_jbatch& b) { twice(b.properties); }},
    {"past-force", [](kaya_jbatch& b) { b.normal_force[b.n] = 1; }},
    {"past-shear", [](kaya_jbatch& b) { b.shear_force[2][b.n + 3] = 1; }},
    {"past-stiffness", [](kaya_jbatch& b) { b.normal_stiffness[b.n] = 1; }},
    {"past-state", [](kaya_jbatch& b) { b.state[b.n] = 1; }},
    {"past-history", [](kaya_jbatch& b) { b.history[0][b.n] = 1; }},
    {"before-force", [](kaya_jbatch& b) { b.normal_force[-1] = 1; }},
    {"before-history", [](kaya_jbatch& b) { b.history[0][-2] = 1; }},
    {"before-work", [](kaya_jbatch& b) { b.frictional_work[-1] = 1; }},
    {"more-history", [](kaya_jbatch& b) { b.history[1][0] = 1; }},
    {"free-column", [](kaya_jbatch& b) { std::free(b.normal_force); }},
    {"more-rows", [](kaya_jbatch& b) { b.n += 4; }},
    {"no-rows", [](kaya_jbatch& b) { b.n = 0; }},
    {"other-columns", [](kaya_jbatch& b) { b.normal_force = b.shear_force[0]; }},
    {"no-columns", [](kaya_jbatch& b) { b.history = nullptr; }},
    {"nan-force", [](kaya_jbatch& b) { b.normal_force[0] = not_a_number; }},
    {"nan-shear", [](kaya_jbatch& b) { b.shear_force[1][b.n - 1] = not_a_number; }},
    {"infinite-force", [](kaya_jbatch& b) { b.normal_force[0] = infinite; }},
    {"nan-history", [](kaya_jbatch& b) { b.history[0][0] = not_a_number; }},
    {"nan-work", [](kaya_jbatch& b) { b.frictional_work[0] = not_a_number; }},
    {"nan-stiffness", [](kaya_jbatch& b) { b.normal_stiffness[0] = not_a_number; b.stiffness_changed = 1; }},
    {"negative-stiffness", [](kaya_jbatch& b) { b.shear_stiffness[0] = -1; b.stiffness_changed = 1; }},
    {"huge-force", [](kaya_jbatch& b) { b.normal_force[0] = 1e300; }},
    {"huge-shear", [](kaya_jbatch& b) { b.shear_force[0][0] = -1e300; }},
    {"small-force", [](kaya_jbatch& b) { b.shear_force[0][0] = 1e-310; }},
};
// clang-format on

/// The result when the order is to return something.
ptrdiff_t answer(std::string_view name, kaya_jbatch& batch) {
    if (name == "row-n") return static_cast<ptrdiff_t>(batch.n);
    if (name == "row-negative") return -7;
    if (name == "row-huge") return std::numeric_limits<ptrdiff_t>::max();
    if (name == "no-reason") return 0;
    if (name == "long-reason") std::memset(batch.message, 'x', sizeof batch.message);
    if (name == "odd-reason") std::strcpy(batch.message, "a \033[31mred\xff\xfe word");
    return name == "long-reason" || name == "odd-reason" ? 0 : -1;
}

ptrdiff_t do_harm(const char* moment, kaya_jbatch& batch) {
    harm::at(moment);
    const auto name = harm::chosen(moment);
    for (const Columns& each : columns)
        if (each.name == name) each.spoil(batch);
    return answer(name, batch);
}

ptrdiff_t initialise(kaya_jbatch* batch) {
    const ptrdiff_t row = do_harm("initialise", *batch);
    return row == -1 ? plugin::set_stiffness(batch) : row;
}

ptrdiff_t run(kaya_jbatch* batch) {
    plugin::push(batch);
    ptrdiff_t row = do_harm("call", *batch);
    if (row == -1 && batch->n > 0 && batch->history != nullptr && batch->history[0][0] >= 40)
        row = do_harm("run", *batch);
    return row;
}

const char* check(const double*) {
    harm::at("check");
    return harm::chosen("check") == "odd-complaint" ? "a \033[31mred\xff word" : nullptr;
}

void stiffness(const double* values, double* normal, double* shear) {
    harm::at("stiffness");
    plugin::report_stiffness(values, normal, shear);
    const auto name = harm::chosen("stiffness");
    if (name == "nan") *normal = not_a_number;
    if (name == "negative") *shear = -1;
    if (name == "zero") *normal = 0;
    if (name == "too-soft") *normal = *shear = 1e-6 * values[0];
}

std::string long_name(1000, 'x');
kaya_jproperty many[1000];
kaya_jhistory much[1000];

struct Entries {
    const char* name;
    void (*spoil)(kaya_jmodel&);
};

// clang-format off
constexpr Entries entries[] = {
    {"null-name", [](kaya_jmodel& m) { m.name = nullptr; }},
    {"empty-name", [](kaya_jmodel& m) { m.name = ""; }},
    {"control-name", [](kaya_jmodel& m) { m.name = "harm\033[31mful"; }},
    {"odd-name", [](kaya_jmodel& m) { m.name = "harm\xff\xfe"; }},
    {"long-name", [](kaya_jmodel& m) { m.name = long_name.c_str(); }},
    {"stolen-name", [](kaya_jmodel& m) { m.name = "mohr"; }},
    {"null-run", [](kaya_jmodel& m) { m.run = nullptr; }},
    {"null-initialise", [](kaya_jmodel& m) { m.initialise = nullptr; }},
    {"null-stiffness", [](kaya_jmodel& m) { m.max_stiffness = nullptr; }},
    {"interface-0", [](kaya_jmodel& m) { m.interface_version = 0; }},
    {"interface-99", [](kaya_jmodel& m) { m.interface_version = 99; }},
    {"size-8", [](kaya_jmodel& m) { m.size = 8; }},
    {"size-huge", [](kaya_jmodel& m) { m.size = 1u << 30; }},
    {"many-properties", [](kaya_jmodel& m) { m.properties = many; m.property_count = 1000; }},
    {"endless-properties", [](kaya_jmodel& m) { m.property_count = ~std::size_t{0}; }},
    {"null-properties", [](kaya_jmodel& m) { m.properties = nullptr; }},
    {"nameless-property", [](kaya_jmodel& m) { many[0].name = nullptr; m.properties = many; }},
    {"empty-property", [](kaya_jmodel& m) { many[0].name = ""; m.properties = many; }},
    {"control-property", [](kaya_jmodel& m) { many[0].name = "k\007"; m.properties = many; }},
    {"twin-properties", [](kaya_jmodel& m) { many[0].name = many[1].name = "k"; m.properties = many; m.property_count = 2; }},
    {"nan-limits", [](kaya_jmodel& m) { many[0].minimum = many[0].maximum = not_a_number; m.properties = many; }},
    {"turned-limits", [](kaya_jmodel& m) { many[0].minimum = 2; many[0].maximum = 1; m.properties = many; }},
    {"much-history", [](kaya_jmodel& m) { m.history = much; m.history_count = 1000; }},
    {"null-history", [](kaya_jmodel& m) { m.history = nullptr; }},
    {"twin-history", [](kaya_jmodel& m) { m.history = much; m.history_count = 2; }},
    {"many-states", [](kaya_jmodel& m) { m.state_names = "a b c d e f g h i j k l m n o p q r s t u v w x y z aa bb cc dd ee ff gg hh ii"; }},
    {"many-fields", [](kaya_jmodel& m) { m.field_count = 1000; }},
};
// clang-format on

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("harmful");
    model.run = run;
    model.initialise = initialise;
    model.check = check;
    model.max_stiffness = stiffness;
    for (auto& property : many) property = {"stiffness", "", "-", "one of many", 1, 0, infinite, 0};
    for (auto& variable : much) variable = {"steps", "-", "one of many"};
    harm::at("describe");
    const auto name = harm::chosen("describe");
    if (name == "null-table") return nullptr;
    if (name == "wild-table") return reinterpret_cast<const kaya_jmodel*>(std::size_t{64});
    for (const Entries& each : entries)
        if (each.name == name) each.spoil(model);
    return &model;
}
