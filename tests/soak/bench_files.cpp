#include "bench_files.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya::soak {

namespace {

struct Model {
    const char* name;
    std::vector<const char*> values;
};

const std::array joint_models{
    Model{"mohr", {"jkn=1e4", "jks=5e3", "jfric=30", "jcoh=0.5"}},
    Model{"elastic", {"jkn=1e5", "jks=1e4"}},
    Model{"barton-bandis", {"jkn=1e5", "jks=1e4", "resfric=25", "jrco=8", "jcso=60", "sigmac=150"}},
    Model{"nonlinear", {"jkn=1e5", "jks=1e4", "jen=0.5", "jes=0.3", "fric=30"}},
    Model{"none-such", {"a=1"}},
};
const std::array zone_models{
    Model{"elastic", {"bulk=4e9", "shear=3e9"}},
    Model{"mohr-coulomb", {"bulk=4e9", "shear=3e9", "cohesion=1e6", "friction=30"}},
    Model{"drucker-prager", {"bulk=4e9", "shear=3e9"}},
    Model{"hoek-brown", {"bulk=4e9", "shear=3e9"}},
    Model{"strain-softening", {"bulk=4e9", "shear=3e9", "cohesion=1e6", "friction=30"}},
    Model{"ubiquitous-joint", {"bulk=4e9", "shear=3e9", "cohesion=1e6", "friction=30"}},
};

constexpr std::array joint_columns{"normal_stress",          "shear_displacement",
                                   "shear_displacement_y",   "normal_displacement",
                                   "boundary_stiffness",     "time",
                                   "shear_stress",           "opening",
                                   "measured_normal_stress", "remark"};
constexpr std::array zone_columns{"xx_strain", "yy_strain", "zz_strain", "xy_strain", "xz_strain", "yz_strain",
                                  "xx_stress", "yy_stress", "zz_stress", "time",      "none"};

/// Of the magnitude of the column.
std::string cell(const std::string& column, Chance& c) {
    if (c.heads(0.01)) return c.heads() ? odd_number(c) : odd_word(c);
    const bool stress = column.ends_with("stress") || column.ends_with("stiffness");
    return fmt::format("{:.4g}", stress ? c.between(-2, 10) : c.between(-5e-3, 5e-3));
}

template <class Columns> std::string path(const Columns& known, std::vector<std::string> columns, Chance& c) {
    for (const char* column : known)
        if (c.heads(0.1)) columns.emplace_back(column);
    const char* between = c.heads(0.8) ? "," : c.heads() ? ";" : "\t";
    std::string text = (c.heads(0.2) ? "# a path\n" : "") + join(columns, between) + "\n";
    int rows = 2 + c.below(8);
    if (c.heads(0.05)) rows = c.below(2);
    for (; rows > 0; --rows) {
        std::vector<std::string> cells;
        for (const auto& column : columns) cells.push_back(cell(column, c));
        if (c.heads(0.01)) cells.pop_back();
        text += join(cells, between) + "\n";
    }
    return text;
}

/// Values that are valid, missing, at limits or odd.
void give_values(const Model& model, std::vector<std::string>& words, Chance& c) {
    for (const std::string value : model.values) {
        if (c.heads(0.05)) continue;
        if (c.heads(0.85)) words.push_back(value);
        else words.push_back(value.substr(0, value.find('=') + 1) + number(c, 0.5));
    }
}

} // namespace

Case bench(Chance& c) {
    Case one;
    const int what = c.below(5);
    const std::string steps = c.heads(0.9) ? std::to_string(1 + c.below(100)) : std::to_string(1 + c.below(2) * 20000);
    if (what < 2) {
        const Model& model = c.of(joint_models);
        one.words = {"jtest", model.name, "path.csv"};
        give_values(model, one.words, c);
        one.files = {
            {"path.csv",
             path(joint_columns, {c.heads() ? "normal_stress" : "normal_displacement", "shear_displacement"}, c)}};
    } else if (what == 2) {
        const Model& model = c.of(joint_models);
        one.words = {"jfit", model.name, "path.csv"};
        give_values(model, one.words, c);
        one.words.insert(
            one.words.end(),
            {"--fit", std::string(model.values.front()).substr(0, std::string(model.values.front()).find('='))});
        one.files = {
            {"path.csv",
             path(joint_columns, {"normal_stress", "shear_displacement", c.heads() ? "shear_stress" : "opening"}, c)}};
    } else {
        const Model& model = c.of(zone_models);
        one.words = {"ztest", model.name, "path.csv"};
        give_values(model, one.words, c);
        if (c.heads(0.3)) one.words.push_back("--stress=-1e6,-1e6," + number(c, 0.3) + ",0,0,0");
        one.files = {{"path.csv", path(zone_columns, {c.heads() ? "zz_strain" : "xz_strain"}, c)}};
    }
    one.words.insert(one.words.end(), {"--steps", steps, "--no-picture"});
    return one;
}

} // namespace kaya::soak
