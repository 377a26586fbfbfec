#include "model/selection.hpp"

#include "model/measure.hpp"

#include <algorithm>

namespace kaya {

namespace {

bool visible(const Model& model, ObjectKind kind, Row row) {
    const auto shown = [&](Row block) { return model.blocks.hidden[block] == 0; };
    const auto both_shown = [&](Row contact) {
        return shown(model.contacts.block1[contact]) && shown(model.contacts.block2[contact]);
    };
    if (kind == ObjectKind::cable_node) return true; // cables are seen through the rock
    if (kind == ObjectKind::contact) return both_shown(row);
    if (kind == ObjectKind::sub_contact) return both_shown(model.sub_contacts.contact[row]);
    return shown(block_of(model, kind, row));
}

} // namespace

std::size_t count_of(const Model& model, ObjectKind kind) {
    switch (kind) {
    case ObjectKind::block: return model.blocks.size();
    case ObjectKind::gridpoint: return model.gridpoints.size();
    case ObjectKind::face: return model.faces.size();
    case ObjectKind::triangle: return model.triangles.size();
    case ObjectKind::zone: return model.zones.size();
    case ObjectKind::contact: return model.contacts.size();
    case ObjectKind::sub_contact: return model.sub_contacts.size();
    case ObjectKind::cable_node: return model.structures.nodes.size();
    }
    return 0;
}

std::vector<Row> select(const Model& model, ObjectKind kind, const RangeTest& test, bool hidden_too) {
    std::vector<Row> rows;
    const auto count = static_cast<Row>(count_of(model, kind));
    for (Row row = 0; row < count; ++row) {
        if (!hidden_too && !visible(model, kind, row)) continue;
        if (!test || test(model, kind, row)) rows.push_back(row);
    }
    return rows;
}

Vec3 reference_point(const Model& model, ObjectKind kind, Row row) {
    switch (kind) {
    case ObjectKind::block: return model.blocks.centroid[row];
    case ObjectKind::gridpoint: return model.gridpoints.position[row];
    case ObjectKind::face: return face_centroid(model, row);
    case ObjectKind::triangle: return triangle_centroid(model, row);
    case ObjectKind::zone: return zone_centroid(model, row);
    case ObjectKind::contact: return model.contacts.position[row];
    case ObjectKind::sub_contact: return model.sub_contacts.position[row];
    case ObjectKind::cable_node: return model.structures.nodes.position[row];
    }
    return Vec3::Zero();
}

Row block_of(const Model& model, ObjectKind kind, Row row) {
    switch (kind) {
    case ObjectKind::block: return row;
    case ObjectKind::gridpoint: return model.gridpoints.block[row];
    case ObjectKind::face: return model.faces.block[row];
    case ObjectKind::triangle: return model.faces.block[model.triangles.face[row]];
    case ObjectKind::zone: return model.zones.block[row];
    case ObjectKind::contact: return model.contacts.block1[row];
    case ObjectKind::sub_contact: return model.contacts.block1[model.sub_contacts.contact[row]];
    case ObjectKind::cable_node: return block_of_node(model, row);
    }
    return no_row;
}

double model_size(const Model& model) {
    constexpr double smallest = 1e-30;
    const auto& position = model.gridpoints.position;
    if (position.empty()) return smallest;
    Vec3 low = position.front(), high = position.front();
    for (const auto& p : position) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return std::max((high - low).norm(), smallest);
}

} // namespace kaya
