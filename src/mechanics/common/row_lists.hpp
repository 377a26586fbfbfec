// Lists of entries by row.
#pragma once

#include "model/tables/column.hpp"
#include "base/id.hpp"

#include <vector>

namespace kaya {

/// For every row of one table the entries that belong to it, in ascending order.
template <class Entry> struct Lists {
    std::vector<Row> start{0}; ///< one more than rows
    std::vector<Entry> entries;

    const Entry* begin(Row row) const { return entries.data() + start[row]; }
    const Entry* end(Row row) const { return entries.data() + start[row + 1]; }
};

/// Counting sort: `each(add)` calls add(row, entry) in ascending order of entries, twice.
template <class Entry, class Each> Lists<Entry> sorted_lists(std::size_t rows, Each each) {
    Lists<Entry> lists;
    lists.start.assign(rows + 1, 0);
    each([&](Row row, const Entry&) { ++lists.start[row + 1]; });
    for (std::size_t i = 0; i < rows; ++i) lists.start[i + 1] += lists.start[i];
    lists.entries.resize(lists.start[rows]);
    std::vector<Row> next(lists.start.begin(), lists.start.end() - 1);
    each([&](Row row, const Entry& entry) { lists.entries[next[row]++] = entry; });
    return lists;
}

} // namespace kaya
