#include "mechanics/boundary.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

namespace kaya {

namespace {

/// Calls of_block(row) once per rigid block and of_gridpoint(row) for the rest.
template <class OfBlock, class OfGridpoint>
void each_body(const Model& model, const std::vector<Row>& gridpoints, OfBlock of_block, OfGridpoint of_gridpoint) {
    std::set<Row> done;
    for (const Row g : gridpoints) {
        const Row block = model.gridpoints.block[g];
        if (model.blocks.deformable[block]) of_gridpoint(g);
        else if (done.insert(block).second) of_block(block);
    }
}

} // namespace

void prescribe_velocity(Model& model, const std::vector<Row>& gridpoints, int axis, double value) {
    const auto bit = static_cast<std::uint8_t>(1 << axis);
    each_body(
        model, gridpoints,
        [&](Row b) {
            model.blocks.fixed[b] |= bit;
            model.blocks.velocity[b][axis] = value;
        },
        [&](Row g) {
            model.gridpoints.fixed[g] |= bit;
            model.gridpoints.velocity[g][axis] = value;
        });
    model.properties_changed = true;
}

void release_velocity(Model& model, const std::vector<Row>& gridpoints, int axis) {
    const auto mask = static_cast<std::uint8_t>(~(1 << axis));
    each_body(
        model, gridpoints, [&](Row b) { model.blocks.fixed[b] &= mask; },
        [&](Row g) { model.gridpoints.fixed[g] &= mask; });
    model.properties_changed = true;
}

void add_load(Model& model, const std::vector<Row>& gridpoints, int axis, double value) {
    for (const Row g : gridpoints) {
        const Row b = model.gridpoints.block[g];
        if (model.blocks.deformable[b]) {
            model.gridpoints.load[g][axis] += value;
            continue;
        }
        const Vec3 force = value * Vec3::Unit(axis);
        model.blocks.load[b] += force;
        model.blocks.torque[b] += (model.gridpoints.position[g] - model.blocks.centroid[b]).cross(force);
    }
    model.properties_changed = true;
}

Stress StressField::at(const Vec3& place) const {
    Stress s = at_origin;
    for (int k = 0; k < 3; ++k) s += place[k] * gradient[k];
    return s;
}

double add_stress(Model& model, const std::vector<Row>& gridpoints, const StressField& stress) {
    const auto listed = [&](Row g) { return std::binary_search(gridpoints.begin(), gridpoints.end(), g); };
    // A face on which another block lies is not exterior.
    std::vector<char> covered(model.faces.size(), 0);
    for (std::size_t c = 0; c < model.contacts.size(); ++c)
        if (model.contacts.touch[c] == Touch::face_face)
            covered[model.contacts.face1[c]] = covered[model.contacts.face2[c]] = 1;
    double loaded = 0;
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        const auto& corners = model.triangles.gridpoints[t];
        if (covered[model.triangles.face[t]]) continue;
        if (!std::all_of(corners.begin(), corners.end(), listed)) continue;
        const auto& x = model.gridpoints.position;
        const Vec3 area = 0.5 * (x[corners[1]] - x[corners[0]]).cross(x[corners[2]] - x[corners[0]]);
        loaded += area.norm();
        // The traction varies linearly: consistent loads are (2 t_k + t_l + t_m) / 12 of the area each.
        std::array<Vec3, 3> force;
        for (int k = 0; k < 3; ++k) force[k] = matrix_of(stress.at(x[corners[k]])) * area;
        for (int k = 0; k < 3; ++k) {
            const Vec3 load = (2 * force[k] + force[(k + 1) % 3] + force[(k + 2) % 3]) / 12.0;
            for (int axis = 0; axis < 3; ++axis) add_load(model, {corners[k]}, axis, load[axis]);
        }
    }
    return loaded;
}

void fix_blocks(Model& model, const std::vector<Row>& rows) {
    for (const Row b : rows) {
        model.blocks.fixed[b] = fix_all;
        model.blocks.velocity[b] = model.blocks.rotational_velocity[b] = Vec3::Zero();
        model.blocks.angular_momentum[b] = Vec3::Zero();
        const Span span = model.blocks.gridpoints[b];
        for (Row g = span.first; g < span.end(); ++g) {
            model.gridpoints.fixed[g] = fix_x | fix_y | fix_z;
            model.gridpoints.velocity[g] = Vec3::Zero();
        }
    }
    model.properties_changed = true;
}

void free_blocks(Model& model, const std::vector<Row>& rows) {
    for (const Row b : rows) {
        model.blocks.fixed[b] = 0;
        const Span span = model.blocks.gridpoints[b];
        for (Row g = span.first; g < span.end(); ++g) model.gridpoints.fixed[g] = 0;
    }
    model.properties_changed = true;
}

} // namespace kaya
