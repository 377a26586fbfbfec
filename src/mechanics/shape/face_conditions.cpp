#include "mechanics/shape/face_conditions.hpp"

#include "mechanics/supports/held_directions.hpp"
#include "mechanics/shape/surfaces.hpp"

#include <algorithm>
#include <map>

namespace kaya {

std::size_t make_quiet(Model& model, const std::vector<Row>& triangles, std::uint8_t bits) {
    std::size_t count = 0;
    for (const Row t : triangles) {
        if (!model.blocks.deformable[model.faces.block[model.triangles.face[t]]]) continue;
        model.triangles.quiet[t] |= bits;
        ++count;
    }
    ModelEdit(model, Change::properties);
    return count;
}

std::size_t hold_normals(Model& model, const std::vector<Row>& triangles, double speed) {
    std::map<Row, Vec3> normals; // of faces
    std::map<Row, Roller> held;  // of gridpoints
    for (const Row t : triangles) {
        const Row face = model.triangles.face[t];
        if (!model.blocks.deformable[model.faces.block[face]]) continue;
        const auto [normal, fresh] = normals.try_emplace(face, Vec3::Zero());
        if (fresh) normal->second = current_normal(model, face);
        for (const Row g : model.triangles.gridpoints[t]) add_direction(held[g], normal->second, speed);
    }
    RollerRows rows(model);
    for (auto& [g, roller] : held) {
        add_directions(roller, model.rollers[static_cast<std::size_t>(model.gridpoints.roller[g])]);
        model.gridpoints.roller[g] = rows.row(roller);
    }
    ModelEdit(model, Change::properties);
    return held.size();
}

void free_faces(Model& model, const std::vector<Row>& gridpoints, std::uint8_t axes) {
    constexpr std::uint8_t all = quiet_x | quiet_y | quiet_z;
    const auto taken = static_cast<std::uint8_t>(axes == all ? all | quiet_normal | quiet_shear : axes);
    const auto listed = [&](Row g) { return std::binary_search(gridpoints.begin(), gridpoints.end(), g); };
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        const auto& corner = model.triangles.gridpoints[t];
        if (model.triangles.quiet[t] != 0 && std::all_of(corner.begin(), corner.end(), listed))
            model.triangles.quiet[t] &= static_cast<std::uint8_t>(~taken);
    }
    if (axes == all)
        for (const Row g : gridpoints) model.gridpoints.roller[g] = 0;
    ModelEdit(model, Change::properties);
}

} // namespace kaya
