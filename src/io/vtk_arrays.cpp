#include "io/vtk_arrays.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace kaya {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// x_velocity of velocity, x of position, xx_stress of stress.
bool is_component(const Field& field) {
    const std::string_view name = field.name;
    const auto has = [&](const std::string& whole) {
        const Field* found = find_field(field.kind, whole);
        return found != nullptr && found != &field;
    };
    if (name == "x" || name == "y" || name == "z") return true;
    if (name.size() > 2 && name[1] == '_' && (name[0] == 'x' || name[0] == 'y' || name[0] == 'z')) {
        const std::string rest(name.substr(2));
        return has(rest) || has(rest + "_vector");
    }
    return field.kind == ObjectKind::zone && name.size() == 9 && name.ends_with("_stress");
}

/// Objects by the numbers that users see.
std::int64_t whole_of(const Model& model, const FieldValue& value) {
    if (const auto* link = std::get_if<Link>(&value)) return object_number(model, *link).value_or(-1);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
    return -1;
}

double real_of(const FieldValue& value) {
    if (const auto* real = std::get_if<double>(&value)) return *real;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    return none;
}

/// The value of each row, or `missing` where the row is `no_row`.
template <class Value, class Get>
std::vector<Value> column(std::span<const Row> rows, const Value& missing, Get&& get) {
    std::vector<Value> values;
    values.reserve(rows.size());
    for (const Row row : rows) values.push_back(row == no_row ? missing : get(row));
    return values;
}

void add_texts(VtuArrays& target, VtuLists& lists, const Model& model, const std::string& name, const Field& field,
               std::span<const Row> rows) {
    auto& texts = lists[name + "_names"];
    std::map<std::string, std::int32_t> places;
    for (const auto& text : texts) places.emplace(text, static_cast<std::int32_t>(places.size()));
    const auto numbers = column<std::int32_t>(rows, -1, [&](Row row) {
        const auto [place, is_new] =
            places.try_emplace(std::get<std::string>(field.get(model, row)), static_cast<std::int32_t>(texts.size()));
        if (is_new) texts.push_back(place->first);
        return place->second;
    });
    target.push_back(vtu_array<std::int32_t>(name, numbers, {.unit = field.unit}));
}

void add_field(VtuArrays& target, VtuLists& lists, const Model& model, const std::string& name, const Field& field,
               std::span<const Row> rows, const FieldValue& sample) {
    const auto value = [&](Row row) { return field.get(model, row); };
    if (std::holds_alternative<std::string>(sample)) return add_texts(target, lists, model, name, field, rows);
    if (std::holds_alternative<Vec3>(sample)) {
        const Vec3 missing = Vec3::Constant(none);
        const auto vectors = column<Vec3>(rows, missing, [&](Row row) { return std::get<Vec3>(value(row)); });
        return target.push_back(vtu_vectors(name, vectors, field.unit));
    }
    if (std::holds_alternative<double>(sample)) {
        const auto reals = column<double>(rows, none, [&](Row row) { return real_of(value(row)); });
        return target.push_back(vtu_array<double>(name, reals, {.unit = field.unit}));
    }
    const auto wholes = column<std::int64_t>(rows, -1, [&](Row row) { return whole_of(model, value(row)); });
    target.push_back(vtu_array<std::int64_t>(name, wholes, {.unit = field.unit}));
}

} // namespace

void add_fields(VtuArrays& target, VtuLists& lists, const Model& model, ObjectKind table, std::span<const Row> rows,
                std::string_view prefix) {
    const auto first = std::ranges::find_if(rows, [](Row row) { return row != no_row; });
    if (first == rows.end()) return; // without a row the type of the values is unknown
    for (const Field& field : fields()) {
        if (field.kind != table || is_component(field)) continue;
        const std::string name = fmt::format("{}{}", prefix, field.name);
        if (target.has(name)) continue;
        add_field(target, lists, model, name, field, rows, field.get(model, *first));
    }
}

void add_own_values(VtuArrays& target, const Model& model, const OwnValues& own, std::span<const Row> rows) {
    std::set<std::string> names;
    for (const auto& properties : model.joint_properties)
        if (const auto found = own.find(properties.model); found != own.end())
            for (const auto& [name, value] : found->second) names.insert(name);
    const auto& contacts = model.contacts;
    const auto& sub_contacts = model.sub_contacts;
    const auto& properties = model.joint_properties;
    for (const auto& name : names) {
        const auto values = column<double>(rows, none, [&](Row row) {
            const Row set =
                contacts.properties[static_cast<std::size_t>(sub_contacts.contact[static_cast<std::size_t>(row)])];
            const auto joint = set == no_row ? own.end() : own.find(properties[static_cast<std::size_t>(set)].model);
            const bool known = joint != own.end() && joint->second.contains(name);
            return known ? joint->second.at(name)(model, row) : none;
        });
        target.push_back(vtu_array<double>("jmodel_" + name, values));
    }
}

} // namespace kaya
