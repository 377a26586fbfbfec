#include "io/field_csv.hpp"

#include "io/csv.hpp"

#include <algorithm>
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

const std::vector<FieldTableName>& field_table_names() {
    static const std::vector<FieldTableName> names{{FieldTable::global, "model"}, {FieldTable::block, "blocks"}, {FieldTable::gridpoint, "gridpoints"}, {FieldTable::face, "faces"},
                                                   {FieldTable::zone, "zones"},   {FieldTable::contact, "contacts"}, {FieldTable::sub_contact, "sub-contacts"},
                                                   {FieldTable::cable_node, "cable-nodes"}};
    return names;
}

std::string field_csv(const Model& model, FieldTable table) {
    const auto rows = static_cast<Row>(row_count(model, table));
    std::vector<const Field*> columns;
    std::string text;
    for (const Field& field : fields()) {
        if (field.table != table) continue;
        // A vector is there by its components; without an object nothing tells what is one.
        if (rows > 0 && std::holds_alternative<Vec3>(field.get(model, 0))) continue;
        text += fmt::format("{}{}", text.empty() ? "" : ",", csv_cell(field.name));
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

std::string field_list_csv() {
    std::string text = "table,field,quantity,meaning\n";
    for (const auto& [table, name] : field_table_names())
        for (const Field& field : fields())
            if (field.table == table) text += fmt::format("{},{},{},{}\n", name, csv_cell(field.name), csv_cell(field.unit), csv_cell(field.help));
    return text;
}

} // namespace kaya
