// A table with a line for each row of a kind of object.
#pragma once

#include "base/units.hpp"
#include "commands/program/text_table.hpp"
#include "model/fields/field.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kaya {

/// A column of such a table: a field of the objects, or another value.
struct ListColumn {
    using Text = std::function<std::string(Row)>;

    std::string_view heading, field;
    Text text; ///< empty: that of the field

    ListColumn(const char* name) : heading(name), field(name) {} // implicit on purpose: a table is a list of names
    ListColumn(std::string_view title, std::string_view name)
        : heading(title), field(name) {} ///< where lists have a shorter word
    ListColumn(const char* title, Text of_row) : heading(title), text(std::move(of_row)) {}
};

/// A field's value as a list shows it: numbers with six digits, objects by their number, "-" for none.
std::string value_text(const Model& model, const FieldValue& value);

class RowTable {
public:
    /// The model must outlive it. Headings of fields name their units, if the session has any: "volume [m^3]".
    RowTable(const Model& model, const Units& units, ObjectKind kind, const std::vector<ListColumn>& columns);

    void add(Row row);
    std::size_t size() const { return table_.size(); }
    std::string text() const { return table_.text(); }

private:
    std::vector<ListColumn::Text> columns_;
    TextTable table_;
};

} // namespace kaya
