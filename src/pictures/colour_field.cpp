#include "pictures/colouring.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace kaya {

namespace {

/// Short words of plot lines.
const std::map<std::string, std::pair<ObjectKind, std::string>>& short_words() {
    using enum ObjectKind;
    static const std::map<std::string, std::pair<ObjectKind, std::string>> words{
        {"disp", {gridpoint, "displacement"}},
        {"dis", {gridpoint, "displacement"}},
        {"vel", {gridpoint, "velocity"}},
        {"xdis", {gridpoint, "x_displacement"}},
        {"ydis", {gridpoint, "y_displacement"}},
        {"zdis", {gridpoint, "z_displacement"}},
        {"xdisp", {gridpoint, "x_displacement"}},
        {"ydisp", {gridpoint, "y_displacement"}},
        {"zdisp", {gridpoint, "z_displacement"}},
        {"xvel", {gridpoint, "x_velocity"}},
        {"yvel", {gridpoint, "y_velocity"}},
        {"zvel", {gridpoint, "z_velocity"}},
        {"sxx", {zone, "xx_stress"}},
        {"syy", {zone, "yy_stress"}},
        {"szz", {zone, "zz_stress"}},
        {"sxy", {zone, "xy_stress"}},
        {"sxz", {zone, "xz_stress"}},
        {"syz", {zone, "yz_stress"}},
        {"smin", {zone, "principal_stress_1"}},
        {"smax", {zone, "principal_stress_3"}},
        {"sig1", {zone, "principal_stress_1"}},
        {"sig3", {zone, "principal_stress_3"}},
        {"mat", {block, "material"}},
        {"cons", {block, "constitutive"}}};
    return words;
}

const std::map<std::string, std::string>& joint_words() {
    static const std::map<std::string, std::string> words{
        {"slip", "shear_displacement"},     {"sdis", "shear_displacement"},
        {"sdisp", "shear_displacement"},    {"open", "normal_displacement"},
        {"opening", "normal_displacement"}, {"ndis", "normal_displacement"},
        {"ndisp", "normal_displacement"},   {"aperture", "normal_displacement"},
        {"nforce", "normal_force"},         {"sforce", "shear_force"},
        {"force", "normal_force"},          {"nstress", "normal_stress"},
        {"nstr", "normal_stress"},          {"sstress", "shear_stress"},
        {"sstr", "shear_stress"},           {"mat", "material"}};
    return words;
}

ColourField made_of(const Field& field) {
    std::string title(field.name);
    std::ranges::replace(title, '_', ' ');
    if (field.unit != "-" && !field.unit.empty()) title += fmt::format(" [{}]", field.unit);
    const bool motion = field.kind == ObjectKind::gridpoint &&
                        (field.name.ends_with("displacement") || field.name.ends_with("velocity"));
    return {field.kind, title, field.get, motion};
}

} // namespace

std::optional<ColourField> find_colour_field(const std::string& word) {
    const auto found = short_words().find(word);
    if (found != short_words().end()) return made_of(*find_field(found->second.first, found->second.second));
    for (const ObjectKind table : {ObjectKind::block, ObjectKind::gridpoint, ObjectKind::zone}) {
        const bool of_points = word == "displacement" || word == "velocity" || word.ends_with("_displacement") ||
                               word.ends_with("_velocity");
        if (table == ObjectKind::block && of_points && word.find("rotational") == std::string::npos) continue;
        if (const Field* field = find_field(table, word)) return made_of(*field);
    }
    return std::nullopt;
}

std::optional<ColourField> find_joint_field(const std::string& word) {
    const auto found = joint_words().find(word);
    const Field* field = find_field(ObjectKind::sub_contact, found != joint_words().end() ? found->second : word);
    if (field == nullptr) return std::nullopt;
    return made_of(*field);
}

std::vector<std::string_view> short_field_words(bool of_joints) {
    std::vector<std::string_view> words;
    if (of_joints)
        for (const auto& [word, name] : joint_words()) words.push_back(word);
    else
        for (const auto& [word, field] : short_words()) words.push_back(word);
    return words;
}

float Colouring::value(const Model& model, Row row) {
    const FieldValue value = field_.get(model, row);
    double number = std::numeric_limits<double>::quiet_NaN();
    if (const auto* text = std::get_if<std::string>(&value)) {
        const auto place = std::ranges::find(bar_.names, text->empty() ? "(none)" : *text);
        number = static_cast<double>(place - bar_.names.begin());
        if (place == bar_.names.end()) bar_.names.push_back(text->empty() ? "(none)" : *text);
    } else if (const auto* vector = std::get_if<Vec3>(&value)) number = vector->norm();
    else if (const auto* real = std::get_if<double>(&value)) number = *real;
    else if (const auto* whole = std::get_if<std::int64_t>(&value)) number = static_cast<double>(*whole);
    if (!std::isfinite(number)) return grey("no value");
    low_ = std::min(low_, number), high_ = std::max(high_, number);
    return static_cast<float>(number);
}

float Colouring::grey(const std::string& why) {
    if (bar_.grey.empty()) bar_.grey = why;
    return std::numeric_limits<float>::quiet_NaN();
}

ColourBar Colouring::bar() const {
    ColourBar bar = colour_bar(field_.title, low_, high_);
    bar.names = bar_.names;
    bar.grey = bar_.grey;
    return bar;
}

ColourBar colour_bar(const std::string& title, double least, double greatest) {
    if (!(least <= greatest)) least = 0, greatest = 1;
    ColourBar bar{title, least, greatest, least, greatest, false, {}, {}};
    const double larger = std::max(-least, greatest);
    bar.diverging = least < -0.05 * larger && greatest > 0.05 * larger;
    if (bar.diverging) bar.low = -larger, bar.high = larger;
    const double margin = least == 0 ? 1 : 0.5 * std::abs(least);
    if (bar.low == bar.high) bar.low -= margin, bar.high += margin;
    return bar;
}

} // namespace kaya
