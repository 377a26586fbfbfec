#include "model/fields/field.hpp"

#include "model/fields/field_rows.hpp"

#include <fmt/format.h>

#include <map>

namespace kaya {

namespace field_rows {

namespace {

const char* kind_of(const FieldValue& value) {
    static constexpr std::array kinds{"a number", "a number", "a vector", "a text", "an object"};
    return kinds[value.index()];
}

} // namespace

double number(const FieldValue& value) {
    if (const auto* real = std::get_if<double>(&value)) {
        if (std::isfinite(*real)) return *real;
        throw Diagnostic(std::isnan(*real) ? "this is not a number: it comes from 0/0 or similar"
                                           : "this number is infinite: it comes from a division by 0 or similar");
    }
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    throw Diagnostic(fmt::format("a number is needed here, and this is {}", kind_of(value)));
}

std::int64_t whole_number(const FieldValue& value) {
    const double real = number(value);
    if (std::nearbyint(real) != real || std::abs(real) > 2147483647.0)
        throw Diagnostic(fmt::format("a whole number is needed here, and this is {}", real));
    return static_cast<std::int64_t>(real);
}

Vec3 vector(const FieldValue& value) {
    if (const auto* given = std::get_if<Vec3>(&value)) {
        for (int k = 0; k < 3; ++k) number((*given)[k]);
        return *given;
    }
    throw Diagnostic(fmt::format("a vector is needed here, and this is {}", kind_of(value)));
}

const std::string& text(const FieldValue& value) {
    if (const auto* given = std::get_if<std::string>(&value)) return *given;
    throw Diagnostic(fmt::format("a text is needed here, and this is {}", kind_of(value)));
}

} // namespace field_rows

namespace {

std::vector<Field> all_fields() {
    using namespace field_rows;
    std::vector<Field> all;
    for (const auto* table :
         {&global_fields(), &block_fields(), &gridpoint_fields(), &face_fields(), &zone_fields(), &contact_fields(),
          &sub_contact_fields(), &corner_fields(), &cable_fields(), &member_fields()})
        all.insert(all.end(), table->begin(), table->end());
    return all;
}

/// Fields by one of their words; those without it share the empty key.
template <class Key, class KeyOf> std::map<Key, const Field*> index_by(KeyOf&& key_of) {
    std::map<Key, const Field*> index;
    for (const auto& field : fields()) index.emplace(key_of(field), &field);
    return index;
}

template <class Key> const Field* find_field(const std::map<Key, const Field*>& index, const Key& key) {
    const auto found = index.find(key);
    return found == index.end() ? nullptr : found->second;
}

} // namespace

std::span<const Field> fields() {
    static const std::vector<Field> all = all_fields();
    return all;
}

const Field* find_field(ObjectKind kind, std::string_view name) {
    using Key = std::pair<ObjectKind, std::string_view>;
    static const auto index = index_by<Key>([](const Field& field) { return Key(field.kind, field.name); });
    return find_field(index, Key(kind, name));
}

const Field* find_classic_field(std::string_view classic) {
    static const auto index = index_by<std::string_view>([](const Field& field) { return field.classic; });
    return classic.empty() ? nullptr : find_field(index, classic);
}

const Field* find_any_field(ObjectKind kind, std::string_view name) {
    for (const auto& field : fields())
        if (field.kind == kind && (field.name == name || field.classic == name || field.modern == name)) return &field;
    return nullptr;
}

std::optional<ObjectKind> find_kind(std::string_view name) {
    if (name == "model") return ObjectKind::global;
    for (const auto& info : kinds())
        if (info.kind < end_of_script_kinds && (info.name == name || std::string(info.name) + "s" == name))
            return info.kind;
    return std::nullopt;
}

std::optional<std::int64_t> object_number(const Model& model, const Link& link) {
    const auto number = info_of(link.kind).number;
    if (link.row == no_row || number == nullptr) return std::nullopt;
    return number(model, link.row);
}

} // namespace kaya
