// Who acts on whom: forces are gathered through these lists, in the order of their rows.
#pragma once

#include "mechanics/run_cables.hpp"
#include "model/joined.hpp"
#include "model/model.hpp"

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

/// Whether gridpoints [row, row + 8) are of deformable blocks. Those of a block follow each other.
inline bool all_in_zones(const Model& model, std::size_t row) {
    const auto& block = model.gridpoints.block;
    if (block[row] == block[row + 7]) return model.blocks.deformable[block[row]];
    bool all = true;
    for (std::size_t l = row; l < row + 8; ++l) all &= model.blocks.deformable[block[l]] != 0;
    return all;
}

/// A weight in one side of a sub-contact.
struct SideEntry {
    Row sub_contact;
    std::int32_t side; ///< 0 or 1
    double weight;
};

/// A contact that a block has.
struct ContactEntry {
    Row contact;
    std::int32_t side; ///< 0 or 1
};

/// A cable node in a rigid block, or in a zone with a corner's part in it.
struct NodeEntry {
    Row node;
    double weight;
};

struct Adjacency {
    Lists<SideEntry> of_gridpoint; ///< gridpoints of deformable blocks
    Lists<ContactEntry> of_block;  ///< rigid blocks
    JoinedBodies bodies;
    Lists<NodeEntry> nodes_of_gridpoint;       ///< cable nodes; no rows where there are no cables
    Lists<NodeEntry> nodes_of_block;           ///< the same of rigid blocks; weight 1
    std::vector<NodeStiffness> node_stiffness; ///< by cable node

    bool has_cables() const { return !node_stiffness.empty(); }
};

Adjacency make_adjacency(const Model& model);

} // namespace kaya
