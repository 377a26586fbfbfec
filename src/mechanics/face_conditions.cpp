#include "mechanics/face_conditions.hpp"

#include "mechanics/surfaces.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace kaya {

namespace {

/// Rollers by what they are, so that gridpoints of one face share one.
class RollerRows {
public:
    explicit RollerRows(Model& model) : rollers_(model.rollers) {
        for (std::size_t i = 0; i < rollers_.size(); ++i) rows_.emplace(key(rollers_[i]), static_cast<std::int32_t>(i));
    }
    std::int32_t row(const Roller& roller) {
        const auto [at, fresh] = rows_.emplace(key(roller), static_cast<std::int32_t>(rollers_.size()));
        if (fresh) rollers_.push_back(roller);
        return at->second;
    }

private:
    using Key = std::array<double, 12>;
    static Key key(const Roller& roller) {
        Key numbers{};
        for (std::size_t k = 0; k < 3; ++k) {
            for (int axis = 0; axis < 3; ++axis) numbers[3 * k + static_cast<std::size_t>(axis)] = roller.direction[k][axis];
            numbers[9 + k] = roller.speed[static_cast<Eigen::Index>(k)];
        }
        return numbers;
    }
    std::vector<Roller>& rollers_;
    std::map<Key, std::int32_t> rows_;
};

/// Normals that differ by less are one direction.
constexpr double parallel = 1e-3;

} // namespace

void add_direction(Roller& roller, Vec3 direction, double speed) {
    if (roller.count == 3) return;
    for (std::int32_t k = 0; k < roller.count; ++k) {
        const Vec3& known = roller.direction[static_cast<std::size_t>(k)];
        const double along = direction.dot(known);
        direction -= along * known;
        speed -= along * roller.speed[k];
    }
    const double length = direction.norm();
    if (length < parallel) return;
    roller.direction[static_cast<std::size_t>(roller.count)] = direction / length;
    roller.speed[roller.count] = speed / length;
    ++roller.count;
}

std::size_t make_quiet(Model& model, const std::vector<Row>& triangles, std::uint8_t bits) {
    std::size_t count = 0;
    for (const Row t : triangles) {
        if (!model.blocks.deformable[model.faces.block[model.triangles.face[t]]]) continue;
        model.triangles.quiet[t] |= bits;
        ++count;
    }
    model.properties_changed = true;
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
        const Roller before = model.rollers[static_cast<std::size_t>(model.gridpoints.roller[g])];
        for (std::int32_t k = 0; k < before.count; ++k)
            add_direction(roller, before.direction[static_cast<std::size_t>(k)], before.speed[k]);
        model.gridpoints.roller[g] = rows.row(roller);
    }
    model.properties_changed = true;
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
    model.properties_changed = true;
}

} // namespace kaya
