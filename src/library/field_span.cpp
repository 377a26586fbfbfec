#include "library/field_span.hpp"

#include "mechanics/assign/contact_properties.hpp"
#include "model/fields/field.hpp"

#include <fmt/format.h>

namespace kaya::library {

namespace {

ObjectKind kind_named(const std::string& name) {
    if (const auto kind = find_kind(name)) return *kind;
    throw Diagnostic(fmt::format("there are no objects of a kind '{}'", name),
                     "for example: block, gridpoint, zone, contact");
}

const Field& field_named(ObjectKind kind, const std::string& kind_name, const std::string& name) {
    if (const Field* field = find_any_field(kind, name)) return *field;
    throw Diagnostic(fmt::format("a {} has no field '{}'", kind_name, name), "docs/fields.md lists them");
}

std::size_t rows_of(Session& session, ObjectKind kind) {
    if (kind == ObjectKind::global) return 1;
    const auto& info = info_of(kind);
    if (info.found_late && !session.engine.inside_cycle) find_contacts(session.engine.model, session.engine.joints);
    return info.count(session.engine.model);
}

} // namespace

kaya_span FieldSpan::read(Session& session, const std::string& kind_name, const std::string& name) {
    const ObjectKind kind = kind_named(kind_name);
    const Field& field = field_named(kind, kind_name, name);
    const std::size_t rows = rows_of(session, kind);
    numbers_.clear(), whole_.clear(), texts_.clear(), addresses_.clear();
    kaya_type type = KAYA_FLOAT64;
    std::size_t each = 1;
    for (std::size_t row = 0; row < rows; ++row) {
        const FieldValue value = field.get(session.engine.model, static_cast<Row>(row));
        if (const auto* number = std::get_if<double>(&value)) {
            numbers_.push_back(*number);
        } else if (const auto* vector = std::get_if<Vec3>(&value)) {
            each = 3;
            numbers_.insert(numbers_.end(), vector->begin(), vector->end());
        } else if (const auto* text = std::get_if<std::string>(&value)) {
            type = KAYA_TEXT;
            texts_.push_back(*text);
        } else {
            type = KAYA_INT64;
            const auto* link = std::get_if<Link>(&value);
            whole_.push_back(link != nullptr ? link->row : std::get<std::int64_t>(value));
        }
    }
    for (const auto& text : texts_) addresses_.push_back(text.c_str());
    const void* values = type == KAYA_FLOAT64 ? static_cast<const void*>(numbers_.data())
                         : type == KAYA_INT64 ? static_cast<const void*>(whole_.data())
                                              : static_cast<const void*>(addresses_.data());
    return {type, rows, each, values};
}

void set_field(Session& session, const std::string& kind_name, const std::string& name, std::size_t row,
               const double* numbers, std::size_t count) {
    const ObjectKind kind = kind_named(kind_name);
    const Field& field = field_named(kind, kind_name, name);
    if (field.set == nullptr) throw Diagnostic(fmt::format("the field '{}' is for reading only", name));
    const std::size_t rows = rows_of(session, kind);
    if (row >= rows)
        throw Diagnostic(fmt::format("there is no row {} of {}", row, kind_name),
                         fmt::format("rows are 0 to {} of {}", rows == 0 ? 0 : rows - 1, rows));
    const FieldValue present = field.get(session.engine.model, static_cast<Row>(row));
    const std::size_t wanted = std::holds_alternative<Vec3>(present) ? 3 : 1;
    if (std::holds_alternative<std::string>(present) || std::holds_alternative<Link>(present))
        throw Diagnostic(fmt::format("the field '{}' is not made of numbers", name), "set it by a command");
    if (count != wanted || numbers == nullptr)
        throw Diagnostic(fmt::format("the field '{}' takes {} number{}, here it is given {}", name, wanted,
                                     wanted == 1 ? "" : "s", count));
    FieldValue value = numbers[0];
    if (wanted == 3) value = Vec3(numbers[0], numbers[1], numbers[2]);
    else if (std::holds_alternative<std::int64_t>(present)) {
        value = static_cast<std::int64_t>(numbers[0]);
        if (static_cast<double>(std::get<std::int64_t>(value)) != numbers[0])
            throw Diagnostic(fmt::format("the field '{}' takes a whole number", name));
    }
    field.set(session.engine.model, static_cast<Row>(row), value);
}

} // namespace kaya::library
