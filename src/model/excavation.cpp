#include "model/excavation.hpp"

#include "model/build.hpp"

#include <algorithm>
#include <numeric>

namespace kaya {

namespace {

/// The rows of the blocks' parts, one block after the other.
std::vector<Row> rows_in(const Column<Span>& spans, const std::vector<Row>& blocks) {
    std::vector<Row> rows;
    for (const Row block : blocks)
        for (Row row = spans[block].first; row < spans[block].end(); ++row) rows.push_back(row);
    return rows;
}

/// Copies blocks with all that belongs to them after those of another set of tables. `From` and `To` are Model or
/// Excavated. Returns the row of the first.
template <class From, class To> Row append_blocks(From& from, const std::vector<Row>& blocks, To& to) {
    const Row first = to.blocks.append(from.blocks, blocks);
    Row gridpoint = to.gridpoints.append(from.gridpoints, rows_in(from.blocks.gridpoints, blocks));
    Row face = to.faces.append(from.faces, rows_in(from.blocks.faces, blocks));
    Row triangle = to.triangles.append(from.triangles, rows_in(from.blocks.triangles, blocks));
    const auto histories = static_cast<std::size_t>(std::max(from.zones.history_columns, to.zones.history_columns));
    from.zones.keep_history(histories);
    to.zones.keep_history(histories);
    Row zone = to.zones.append(from.zones, rows_in(from.blocks.zones, blocks));
    for (Row b = first; b < static_cast<Row>(to.blocks.size()); ++b) {
        // Rows of a block move together, so that one difference serves all links to them.
        const auto place = [](Span& span, Row& next) {
            const Row by = next - span.first;
            span.first = next;
            next += span.count;
            return by;
        };
        const Row by_gridpoint = place(to.blocks.gridpoints[b], gridpoint);
        const Row by_face = place(to.blocks.faces[b], face);
        const Row by_triangle = place(to.blocks.triangles[b], triangle);
        place(to.blocks.zones[b], zone);
        const auto each = [](const Span& span, auto change) {
            for (Row row = span.first; row < span.end(); ++row) change(row);
        };
        each(to.blocks.gridpoints[b], [&](Row g) { to.gridpoints.block[g] = b; });
        each(to.blocks.faces[b], [&](Row f) {
            to.faces.block[f] = b;
            to.faces.triangles[f].first += by_triangle;
        });
        each(to.blocks.triangles[b], [&](Row t) {
            to.triangles.face[t] += by_face;
            for (Row& g : to.triangles.gridpoints[t]) g += by_gridpoint;
        });
        each(to.blocks.zones[b], [&](Row z) {
            to.zones.block[z] = b;
            for (Row& g : to.zones.gridpoints[z]) g += by_gridpoint;
        });
    }
    return first;
}

/// New material has not moved and carries nothing.
void put_to_rest(Model& model, Row b) {
    auto& blocks = model.blocks;
    for (auto* column :
         {&blocks.velocity, &blocks.rotational_velocity, &blocks.angular_momentum, &blocks.displacement, &blocks.force,
          &blocks.moment, &blocks.load, &blocks.torque, &blocks.last_force, &blocks.last_moment})
        (*column)[b] = Vec3::Zero();
    blocks.load_arms[b] = Mat3::Zero();
    blocks.travelled[b] = 0;
    blocks.body[b] = blocks.tied_shape[b] = 0;
    auto& points = model.gridpoints;
    for (Row g = blocks.gridpoints[b].first; g < blocks.gridpoints[b].end(); ++g)
        for (auto* column :
             {&points.velocity, &points.displacement, &points.force, &points.load, &points.last_force})
            (*column)[g] = Vec3::Zero();
    for (Row z = blocks.zones[b].first; z < blocks.zones[b].end(); ++z) {
        model.zones.stress[z] = model.zones.dashpot[z] = Stress::Zero();
        model.zones.forget(z);
    }
}

/// Rows of blocks follow their numbers, whatever order they were made in.
void put_in_number_order(Model& model) {
    auto& blocks = model.blocks;
    if (std::is_sorted(blocks.number.begin(), blocks.number.end())) return;
    std::vector<Row> order(blocks.size()), renamed(blocks.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Row a, Row b) { return blocks.number[a] < blocks.number[b]; });
    blocks.gather(order);
    for (std::size_t b = 0; b < order.size(); ++b) {
        renamed[order[b]] = static_cast<Row>(b);
        blocks.ids.move(blocks.id[b], static_cast<Row>(b));
    }
    put_in_block_order(model);
    for (auto* column : {&model.contacts.block1, &model.contacts.block2})
        for (Row& block : *column) block = renamed[block];
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
    model.structure_changed = model.properties_changed = true;
}

Model excavated_model(const Model& model) {
    Model result;
    result.blocks = model.excavated.blocks;
    result.gridpoints = model.excavated.gridpoints;
    result.faces = model.excavated.faces;
    result.triangles = model.excavated.triangles;
    result.zones = model.excavated.zones;
    result.group_names = model.group_names;
    result.next_block_number = model.next_block_number;
    result.next_shape_number = model.next_shape_number;
    return result;
}

} // namespace kaya
