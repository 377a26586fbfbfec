// FISH tables: numbered lists of pairs (x, y), kept sorted by x. `table 1 read f`, table(1, x), xtable(1, i).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace kaya::script {

struct TablePoint {
    double x = 0;
    double y = 0;
};

/// One table. Points with the same x keep the order of insertion (a step).
class Table {
public:
    /// Linear between points; the first or last y outside. Throws Diagnostic when empty.
    double at(double x) const;
    /// Adds a point in its place; a point with exactly this x gets the new y.
    void set(double x, double y);
    /// Adds a point after all points with the same or a smaller x.
    void insert(double x, double y);

    std::vector<TablePoint> points;
    std::string name; ///< value of table_name; may be empty
};

/// All tables by number.
using Tables = std::map<std::int64_t, Table>;

} // namespace kaya::script
