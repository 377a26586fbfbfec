// Columns and tables. A table lists its columns once, in columns(); growing, saving, restoring,
// hashing and exporting all go through that list.
#pragma once

#include "base/vector.hpp"
#include "model/tables/roles.hpp"
#include "model/tables/row_moves.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace kaya {

/// One quantity of all rows. T is a plain type: bits are the value (save and hash depend on it).
template <class T> using Column = std::vector<T>;

/// A vector quantity kept as three columns, for loops that take eight rows at a time.
struct VectorColumn {
    std::array<Column<double>, 3> component;

    Vec3 operator[](std::size_t row) const { return {component[0][row], component[1][row], component[2][row]}; }
    void set(std::size_t row, const Vec3& value) {
        for (int k = 0; k < 3; ++k) component[k][row] = value[k];
    }
};

/// Operations of every table, given `template <class Visit> void columns(Visit&&)` in Derived. Visit is called as visit("name", column,
/// role) with a Column<T>& and a Role or ColumnRole.
template <class Derived> class Table {
public:
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }

    /// New rows are zero.
    void resize(std::size_t n) {
        derived().columns([n](std::string_view, auto& column, Role) {
            using Value = typename std::decay_t<decltype(column)>::value_type;
            column.resize(n, new_value<Value>());
        });
        size_ = n;
    }

    /// Keeps the listed rows, in that order. `rows` may repeat a row; a negative one is a new row.
    void gather(const std::vector<std::int32_t>& rows) {
        const RowMoves moves(rows);
        derived().columns([&](std::string_view, auto& column, Role) {
            using Value = typename std::decay_t<decltype(column)>::value_type;
            if (std::is_trivially_destructible_v<Value> || moves.in_order()) {
                moves.apply(column);
            } else {
                // Types with heap memory are moved with their row, and copied for all but the last user of a row.
                std::decay_t<decltype(column)> kept;
                kept.reserve(rows.size());
                std::vector<std::size_t> last(column.size(), 0);
                for (std::size_t k = 0; k < rows.size(); ++k)
                    if (rows[k] >= 0) last[static_cast<std::size_t>(rows[k])] = k;
                for (std::size_t k = 0; k < rows.size(); ++k) {
                    const auto row = static_cast<std::size_t>(rows[k]);
                    if (rows[k] < 0) kept.push_back(new_value<Value>());
                    else if (last[row] == k) kept.push_back(std::move(column[row]));
                    else kept.push_back(column[row]);
                }
                column = std::move(kept);
            }
        });
        size_ = rows.size();
    }

    /// Puts copies of the rows listed of another table after the rows of this one. Returns the row of the first.
    std::int32_t append(Derived& from, const std::vector<std::int32_t>& rows) {
        std::vector<void*> columns;
        from.columns([&columns](std::string_view, auto& column, Role) { columns.push_back(&column); });
        std::size_t next = 0;
        derived().columns([&](std::string_view, auto& column, Role) {
            const auto& source = *static_cast<std::decay_t<decltype(column)>*>(columns[next++]);
            for (const auto row : rows) column.push_back(source[static_cast<std::size_t>(row)]);
        });
        const auto first = static_cast<std::int32_t>(size_);
        size_ += rows.size();
        return first;
    }

    /// Releases spare capacity.
    void trim() {
        derived().columns([](std::string_view, auto& column, Role) { column.shrink_to_fit(); });
    }

private:
    Derived& derived() { return static_cast<Derived&>(*this); }
    std::size_t size_ = 0;
};

/// For columns() of a table that holds vector columns.
template <class Visit> void visit_vector(Visit&& visit, const std::string& name, VectorColumn& column, Role role) {
    static constexpr std::array axes{"_x", "_y", "_z"};
    for (int k = 0; k < 3; ++k) visit(name + axes[k], column.component[k], role);
}

} // namespace kaya
