#include "io/field_csv.hpp"

#include "base/csv.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya {

namespace {

std::string cell_of(const Model& model, const FieldValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return csv_cell(*text);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
    if (const auto* real = std::get_if<double>(&value)) return csv_cell(*real);
    const auto* link = std::get_if<Link>(&value);
    const auto number = link == nullptr ? std::nullopt : object_number(model, *link);
    return number ? fmt::format("{}", *number) : std::string();
}

} // namespace

std::span<const ObjectKind> exported_kinds() {
    using enum ObjectKind;
    static constexpr std::array all{global,      block,      gridpoint,      face,         zone,         contact,
                                    sub_contact, cable_node, structure_node, beam_element, liner_element};
    return all;
}

std::string field_csv(const Model& model, ObjectKind kind, const Units& units) {
    const auto rows = static_cast<Row>(count_of(model, kind));
    std::vector<const Field*> columns;
    std::string text;
    for (const Field& field : fields()) {
        if (field.kind != kind) continue;
        // A vector is written by its components; it is recognised by the first object.
        if (rows > 0 && std::holds_alternative<Vec3>(field.get(model, 0))) continue;
        text += fmt::format("{}{}", text.empty() ? "" : ",", csv_cell(units.heading(field.name, field.unit)));
        columns.push_back(&field);
    }
    text += '\n';
    for (Row row = 0; row < rows; ++row) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
            if (k > 0) text += ',';
            text += cell_of(model, columns[k]->get(model, row));
        }
        text += '\n';
    }
    return text;
}

std::string field_list_csv(const Units& units) {
    std::string text = "table,field,quantity,meaning\n";
    for (const ObjectKind kind : exported_kinds())
        for (const Field& field : fields())
            if (field.kind == kind)
                text += fmt::format("{},{},{},{}\n", info_of(kind).file, csv_cell(field.name),
                                    csv_cell(units.label(field.unit)), csv_cell(field.help));
    return text;
}

} // namespace kaya
