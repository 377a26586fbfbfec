#include "model/edit/excavation.hpp"

#include "model/edit/build.hpp"
#include "model/edit/links.hpp"

#include <algorithm>
#include <numeric>

namespace kaya {

namespace {

/// Rows of a block's parts, copied from one table to the end of another.
template <class TableType> struct CopiedRows {
    Row first;
    Renamed renamed; ///< by row of the table that they are copied from

    CopiedRows(TableType& from, const std::vector<Row>& rows, TableType& to)
        : first(to.append(from, rows)), renamed(from.size(), no_row) {
        for (std::size_t i = 0; i < rows.size(); ++i)
            renamed[static_cast<std::size_t>(rows[i])] = first + static_cast<Row>(i);
    }
    CopiedRows(TableType& from, const Column<Span>& spans, const std::vector<Row>& blocks, TableType& to)
        : CopiedRows(from, rows_in(spans, blocks), to) {}

    static std::vector<Row> rows_in(const Column<Span>& spans, const std::vector<Row>& blocks) {
        std::vector<Row> rows;
        for (const Row block : blocks)
            for (Row row = spans[block].first; row < spans[block].end(); ++row) rows.push_back(row);
        return rows;
    }
};

/// Copies blocks with all their parts behind those of another set of tables. `From` and `To` are Model or Excavated. Returns the row of the
/// first.
template <class From, class To> Row append_blocks(From& from, const std::vector<Row>& rows, To& to) {
    to.zones.keep_as(from.zones);
    from.zones.keep_as(to.zones);
    const CopiedRows<Blocks> blocks(from.blocks, rows, to.blocks);
    const CopiedRows<Gridpoints> gridpoints(from.gridpoints, from.blocks.gridpoints, rows, to.gridpoints);
    const CopiedRows<Faces> faces(from.faces, from.blocks.faces, rows, to.faces);
    const CopiedRows<Triangles> triangles(from.triangles, from.blocks.triangles, rows, to.triangles);
    const CopiedRows<Zones> zones(from.zones, from.blocks.zones, rows, to.zones);
    const auto follow = [&](auto& table, Row first) {
        links::renumber_rows<Blocks>(table, first, blocks.renamed);
        links::renumber_rows<Gridpoints>(table, first, gridpoints.renamed);
        links::renumber_rows<Faces>(table, first, faces.renamed);
        links::renumber_rows<Triangles>(table, first, triangles.renamed);
    };
    follow(to.gridpoints, gridpoints.first);
    follow(to.faces, faces.first);
    follow(to.triangles, triangles.first);
    follow(to.zones, zones.first);
    // Spans of blocks are consecutive, including empty ones.
    const auto place = [&](Column<Span>& spans, Row next) {
        for (auto span = spans.begin() + blocks.first; span != spans.end(); ++span) {
            span->first = next;
            next += span->count;
        }
    };
    place(to.blocks.gridpoints, gridpoints.first);
    place(to.blocks.faces, faces.first);
    place(to.blocks.triangles, triangles.first);
    place(to.blocks.zones, zones.first);
    return blocks.first;
}

/// New material has not moved and carries nothing, and is joined to nothing.
void put_to_rest(Model& model, Row b) {
    const std::initializer_list<Role> gone{Role::load, Role::motion, Role::displacement, Role::state};
    auto& blocks = model.blocks;
    links::clear(blocks, {b, 1}, gone);
    links::clear(model.gridpoints, blocks.gridpoints[b], gone);
    links::clear(model.zones, blocks.zones[b], gone);
    blocks.body[b] = blocks.tied_shape[b] = 0;
}

/// Sorts rows of blocks by number, independent of the order of creation.
void put_in_number_order(Model& model) {
    auto& blocks = model.blocks;
    if (std::is_sorted(blocks.number.begin(), blocks.number.end())) return;
    std::vector<Row> order(blocks.size());
    Renamed renamed(blocks.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Row a, Row b) { return blocks.number[a] < blocks.number[b]; });
    blocks.gather(order);
    for (std::size_t b = 0; b < order.size(); ++b) {
        renamed[order[b]] = static_cast<Row>(b);
        blocks.ids.move(blocks.id[b], static_cast<Row>(b));
    }
    renumber<Blocks>(model, renamed);
    put_in_block_order(model);
}

} // namespace

void excavate_blocks(Model& model, const std::vector<Row>& blocks) {
    const Row first = append_blocks(model, blocks, model.excavated);
    for (Row b = first; b < static_cast<Row>(model.excavated.blocks.size()); ++b) {
        model.excavated.blocks.id[b] = {};
        model.excavated.blocks.body[b] = 0;
    }
    delete_blocks(model, blocks);
}

void fill_blocks(Model& model, const std::vector<Row>& rows) {
    const ModelEdit edit(model, Change::rows);
    auto& kept = model.excavated;
    const Row first = append_blocks(kept, rows, model);
    for (Row b = first; b < static_cast<Row>(model.blocks.size()); ++b) {
        model.blocks.id[b] = model.blocks.ids.create(b);
        put_to_rest(model, b);
    }
    put_in_number_order(model);
    std::vector<bool> gone(kept.blocks.size(), false);
    for (const Row row : rows) gone[row] = true;
    std::vector<Row> left;
    for (std::size_t b = 0; b < gone.size(); ++b)
        if (!gone[b]) left.push_back(static_cast<Row>(b));
    Excavated rest;
    append_blocks(kept, left, rest);
    kept = std::move(rest);
}

Model excavated_model(const Model& model) {
    Model result;
    result.blocks = model.excavated.blocks;
    result.gridpoints = model.excavated.gridpoints;
    result.faces = model.excavated.faces;
    result.triangles = model.excavated.triangles;
    result.zones = model.excavated.zones;
    result.group_names = model.group_names;
    result.zone_properties = model.zone_properties;
    result.rollers = model.rollers;
    result.next_block_number = model.next_block_number;
    result.next_shape_number = model.next_shape_number;
    return result;
}

} // namespace kaya
