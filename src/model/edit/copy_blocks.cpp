#include "model/edit/copy_blocks.hpp"

#include "model/edit/build.hpp"
#include "model/edit/joined.hpp"
#include "model/edit/links.hpp"
#include "model/measure/cell_corners.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <map>

namespace kaya {

namespace {

/// A reflection reverses the order of corners.
bool reflects(const Placement& placement) { return placement.turn.determinant() < 0; }

/// The block's shape at the new place; its faces keep their order.
Polyhedron placed_shape(const Model& model, Row block, const Placement& placement) {
    Polyhedron shape = shape_of(model, block);
    for (Vec3& vertex : shape.vertices) vertex = placement(vertex);
    if (reflects(placement))
        for (auto& face : shape.faces) std::reverse(face.vertices.begin(), face.vertices.end());
    return shape;
}

/// The block's zones at the new place.
TetMesh placed_mesh(const Model& model, Row block, const Placement& placement) {
    const bool turned = reflects(placement);
    const Span points = model.blocks.gridpoints[block], faces = model.blocks.faces[block];
    TetMesh mesh;
    for (Row g = points.first; g < points.end(); ++g) mesh.points.push_back(placement(model.gridpoints.position[g]));
    const auto local = [&](Row g) { return static_cast<int>(g - points.first); };
    mesh.per_cell = model.blocks.cell_zones[block];
    const bool exchanged = turned && mesh.per_cell == zones_of_cell;
    const Row first = model.blocks.zones[block].first;
    for (Row z = first; z < model.blocks.zones[block].end(); ++z) {
        // In a mirrored cell the second and the third axis change places: each zone is on the other side of the first.
        constexpr Row half = zones_of_cell / 2;
        const Row from = !exchanged ? z : (z - first) % zones_of_cell < half ? z + half : z - half;
        const auto& g = model.zones.gridpoints[from];
        mesh.tetrahedra.push_back({local(g[0]), local(g[1]), local(g[2]), local(g[3])});
        if (turned) std::swap(mesh.tetrahedra.back()[2], mesh.tetrahedra.back()[3]);
    }
    for (Row t = model.blocks.triangles[block].first; t < model.blocks.triangles[block].end(); ++t) {
        const auto& g = model.triangles.gridpoints[t];
        mesh.boundary.push_back(
            {{local(g[0]), local(g[1]), local(g[2])}, static_cast<int>(model.triangles.face[t] - faces.first)});
        if (turned) std::swap(mesh.boundary.back().points[1], mesh.boundary.back().points[2]);
    }
    return mesh;
}

Row copy_block(Model& model, Row block, const Placement& placement) {
    const Polyhedron shape = placed_shape(model, block, placement);
    const Row copy = add_block(model, shape, {});
    auto& blocks = model.blocks;
    if (blocks.deformable[block]) give_zones(model, copy, shape, placed_mesh(model, block, placement));
    // Settings given by the user to the block and its parts.
    const auto copy_settings = [](auto& table, const Span& from, const Span& to) {
        links::take_over(table, to.first, table, from.first, std::min(from.count, to.count), {Role::setting});
    };
    copy_settings(blocks, {block, 1}, {copy, 1});
    copy_settings(model.faces, blocks.faces[block], blocks.faces[copy]);
    copy_settings(model.zones, blocks.zones[block], blocks.zones[copy]);
    return copy;
}

} // namespace

Placement reflection(const Vec3& normal, const Vec3& origin) {
    return {Mat3::Identity() - 2 * normal * normal.transpose(), 2 * normal.dot(origin) * normal};
}

Row copy_blocks(Model& model, const std::vector<Row>& rows, const std::vector<Placement>& placements) {
    const Row first = static_cast<Row>(model.blocks.size());
    for (const Placement& placement : placements)
        for (const Row block : rows) copy_block(model, block, placement);
    put_in_block_order(model);
    std::vector<std::pair<Row, Row>> pairs;
    for (Row copies = first; copies < static_cast<Row>(model.blocks.size()); copies += static_cast<Row>(rows.size())) {
        std::map<std::int32_t, Row> first_of_body;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::int32_t body = model.blocks.body[rows[i]];
            const Row copy = copies + static_cast<Row>(i);
            if (body == 0) continue;
            const auto [found, is_first] = first_of_body.try_emplace(body, copy);
            if (!is_first) pairs.emplace_back(found->second, copy);
        }
    }
    if (!pairs.empty()) join_pairs(model, pairs);
    return first;
}

} // namespace kaya
