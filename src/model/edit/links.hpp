// Loops over columns by role: links that follow moved rows, and rows that inherit from others.
#pragma once

#include "model/tables/model.hpp"

#include <algorithm>
#include <initializer_list>
#include <type_traits>
#include <vector>

namespace kaya {

/// New numbers of the rows of a table; no_row: deleted.
using Renamed = std::vector<Row>;

namespace links {

/// Whether a column names rows of the table `To`, or the list `To` of the model.
template <class To, class ColumnRoleType> constexpr bool names() {
    return std::is_same_v<ColumnRoleType, ColumnRole<To>>;
}

inline void rename(Row& row, const Renamed& renamed) {
    if (row != no_row) row = renamed[static_cast<std::size_t>(row)];
}
template <std::size_t n> void rename(std::array<Row, n>& rows, const Renamed& renamed) {
    for (Row& row : rows) rename(row, renamed);
}
/// Rows of a span stay together and in order.
inline void rename(Span& span, const Renamed& renamed) {
    if (static_cast<std::size_t>(span.first) < renamed.size())
        span.first = std::max(renamed[static_cast<std::size_t>(span.first)], 0);
}
/// A side that lost one of its gridpoints because the shape of its block changed is unattached until its geometry is rebuilt.
inline void rename(Attachment& side, const Renamed& renamed) {
    bool lost = false;
    for (std::size_t k = 0; k < side.gridpoints.size(); ++k) {
        rename(side.gridpoints[k], renamed);
        lost = lost || (side.weights[k] != 0 && side.gridpoints[k] == no_row);
    }
    if (lost) side = Attachment{};
}

/// Links of the rows from `first` on of a table to rows of `To`.
template <class To, class TableType> void renumber_rows(TableType& table, Row first, const Renamed& renamed) {
    table.columns([&](std::string_view, auto& column, auto role) {
        if constexpr (names<To, decltype(role)>()) {
            using Value = typename std::decay_t<decltype(column)>::value_type;
            // An id needs no other name when rows move.
            if constexpr (requires(Value & value) { rename(value, renamed); })
                if (role == Role::link)
                    for (auto value = column.begin() + first; value != column.end(); ++value) rename(*value, renamed);
        }
    });
}

/// In the columns with one of the roles, copies `count` rows of another table, starting at `from_row`, to those starting at `row`.
template <class TableType>
void take_over(TableType& table, Row row, TableType& from, Row from_row, Row count, std::initializer_list<Role> roles) {
    std::vector<void*> sources;
    from.columns([&](std::string_view, auto& column, Role) { sources.push_back(&column); });
    std::size_t next = 0;
    table.columns([&](std::string_view, auto& column, Role role) {
        const auto& source = *static_cast<std::decay_t<decltype(column)>*>(sources[next++]);
        for (const Role wanted : roles)
            if (role == wanted) std::copy_n(source.begin() + from_row, count, column.begin() + row);
    });
}

/// A part of the vectors and tensors of a row that have the role.
template <class TableType> void scale(TableType& table, Row row, double part, Role wanted) {
    table.columns([&](std::string_view, auto& column, Role role) {
        using Value = typename std::decay_t<decltype(column)>::value_type;
        if constexpr (requires { Value::Zero(); })
            if (role == wanted) column[static_cast<std::size_t>(row)] *= part;
    });
}

/// Zero, in the rows of a span, in all columns that have one of the roles.
template <class TableType> void clear(TableType& table, const Span& rows, std::initializer_list<Role> roles) {
    table.columns([&](std::string_view, auto& column, Role role) {
        using Value = typename std::decay_t<decltype(column)>::value_type;
        for (const Role wanted : roles)
            if (role == wanted) std::fill_n(column.begin() + rows.first, rows.count, new_value<Value>());
    });
}
template <class TableType> void clear(TableType& table, std::initializer_list<Role> roles) {
    clear(table, {0, static_cast<Row>(table.size())}, roles);
}

} // namespace links

/// Renumbers all references to rows of the table `To`.
template <class To> void renumber(Model& model, const Renamed& renamed) {
    model.present_tables([&](const char*, auto& table) { links::renumber_rows<To>(table, 0, renamed); });
}

} // namespace kaya
