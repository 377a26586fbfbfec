// FISH tables: numbered lists of pairs (x, y), which interpolate where they are sorted by x. `table 1 read f`, table(1, x), xtable(1, i).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kaya::script {

struct TablePoint {
    double x = 0;
    double y = 0;
};

/// One table. Points with the same x keep the order of insertion (a step).
class Table {
public:
    /// Linear between points; the first or last y outside. Throws Diagnostic when the table is empty or not sorted.
    double at(double x) const;
    /// Adds a point in its place; a point with exactly this x gets the new y. Throws Diagnostic when the table is not sorted.
    void set(double x, double y);
    /// Adds a point after all points with the same or a smaller x. Throws Diagnostic when the table is not sorted.
    void insert(double x, double y);

    const std::vector<TablePoint>& points() const { return points_; }
    /// Replaces all points. They keep their order, sorted or not.
    void replace(std::vector<TablePoint> points);
    /// Replaces point i, or adds one after the last. The others keep their places, so that the table may be unsorted afterwards.
    void put(std::size_t i, const TablePoint& point);

    /// Throws Diagnostic where x decreases from one point to the next; `name` is what the message calls the table.
    void require_sorted(std::string_view name = "the table") const;

    std::string name; ///< value of table_name; may be empty

private:
    std::size_t steps_back(std::size_t from, std::size_t to) const;

    std::vector<TablePoint> points_;
    std::size_t steps_back_ = 0; ///< points whose x is smaller than that of the point before them
};

/// All tables by number.
using Tables = std::map<std::int64_t, Table>;

} // namespace kaya::script
