#include "commands/list/row_table.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace kaya {

namespace {

std::vector<std::string> headings_of(const Units& units, ObjectKind kind, const std::vector<ListColumn>& columns) {
    std::vector<std::string> headings;
    for (const auto& column : columns) {
        const Field* field = column.text ? nullptr : find_field(kind, column.field);
        headings.push_back(units.heading(column.heading, field == nullptr ? std::string_view() : field->unit));
    }
    return headings;
}

ListColumn::Text text_of(const Model& model, ObjectKind kind, const ListColumn& column) {
    if (column.text) return column.text;
    const Field* field = find_field(kind, column.field);
    if (field == nullptr) throw std::logic_error(fmt::format("{} has no field {}", info_of(kind).name, column.field));
    if (field->name == "position")
        return [&model, field](Row row) { return coordinates_text(std::get<Vec3>(field->get(model, row))); };
    return [&model, field](Row row) { return value_text(model, field->get(model, row)); };
}

} // namespace

std::string value_text(const Model& model, const FieldValue& value) {
    if (const auto* real = std::get_if<double>(&value)) return number_text(*real);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
    if (const auto* v = std::get_if<Vec3>(&value))
        return fmt::format("{}, {}, {}", number_text((*v)[0]), number_text((*v)[1]), number_text((*v)[2]));
    if (const auto* text = std::get_if<std::string>(&value)) return text->empty() ? "-" : *text;
    const auto number = object_number(model, std::get<Link>(value));
    return number ? std::to_string(*number) : "-";
}

RowTable::RowTable(const Model& model, const Units& units, ObjectKind kind, const std::vector<ListColumn>& columns)
    : table_(headings_of(units, kind, columns)) {
    for (const auto& column : columns) columns_.push_back(text_of(model, kind, column));
}

void RowTable::add(Row row) {
    std::vector<std::string> words;
    for (const auto& text : columns_) words.push_back(text(row));
    table_.add(std::move(words));
}

} // namespace kaya
