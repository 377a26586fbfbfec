#include "model/measure/measure.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>

namespace kaya {

namespace {

/// Mean of a gridpoint column over a block, weighted with mass.
Vec3 gridpoint_mean(const Model& model, Row block, const Column<Vec3>& column) {
    const Span span = model.blocks.gridpoints[block];
    double total = 0;
    for (Row i = span.first; i < span.end(); ++i) total += model.gridpoints.mass[i];
    Vec3 sum = Vec3::Zero();
    for (Row i = span.first; i < span.end(); ++i) sum += (total > 0 ? model.gridpoints.mass[i] : 1.0) * column[i];
    const double weight = total > 0 ? total : span.count;
    return weight > 0 ? Vec3(sum / weight) : Vec3(Vec3::Zero());
}

Vec3 gridpoint_sum(const Model& model, Row block, const Column<Vec3>& column) {
    const Span span = model.blocks.gridpoints[block];
    Vec3 sum = Vec3::Zero();
    for (Row i = span.first; i < span.end(); ++i) sum += column[i];
    return sum;
}

} // namespace

Vec3 triangle_area_vector(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * (b - a).cross(c - a); }

Vec3 triangle_area_vector(const Model& model, Row triangle) {
    const auto& corner = model.triangles.gridpoints[triangle];
    const auto& position = model.gridpoints.position;
    return triangle_area_vector(position[corner[0]], position[corner[1]], position[corner[2]]);
}

Vec3 weights_in_triangle(const std::array<Vec3, 3>& corners, const Vec3& place) {
    const Vec3 area = triangle_area_vector(corners[0], corners[1], corners[2]);
    Vec3 weights;
    for (int k = 0; k < 3; ++k)
        weights[k] =
            area.dot(triangle_area_vector(place, corners[(k + 1) % 3], corners[(k + 2) % 3])) / area.squaredNorm();
    return weights;
}

Vec3 triangle_centroid(const Model& model, Row triangle) {
    const auto& corner = model.triangles.gridpoints[triangle];
    const auto& position = model.gridpoints.position;
    return (position[corner[0]] + position[corner[1]] + position[corner[2]]) / 3.0;
}

Vec3 face_area_vector(const Model& model, Row face) {
    const Span span = model.faces.triangles[face];
    Vec3 sum = Vec3::Zero();
    for (Row t = span.first; t < span.end(); ++t) sum += triangle_area_vector(model, t);
    return sum;
}

Vec3 face_centroid(const Model& model, Row face) {
    const Span span = model.faces.triangles[face];
    Vec3 weighted = Vec3::Zero(), plain = Vec3::Zero();
    double area = 0;
    for (Row t = span.first; t < span.end(); ++t) {
        const double part = triangle_area_vector(model, t).norm();
        const Vec3 centroid = triangle_centroid(model, t);
        weighted += part * centroid;
        plain += centroid;
        area += part;
    }
    if (area > 0) return weighted / area;
    return span.count > 0 ? Vec3(plain / span.count) : Vec3(Vec3::Zero());
}

std::vector<Row> face_gridpoints(const Model& model, Row face) {
    std::vector<Row> rows;
    const Span span = model.faces.triangles[face];
    for (Row t = span.first; t < span.end(); ++t)
        for (const Row corner : model.triangles.gridpoints[t])
            if (std::find(rows.begin(), rows.end(), corner) == rows.end()) rows.push_back(corner);
    return rows;
}

double zone_volume(const Model& model, Row zone) {
    const auto& corner = model.zones.gridpoints[zone];
    const auto& position = model.gridpoints.position;
    const Vec3 a = position[corner[1]] - position[corner[0]];
    const Vec3 b = position[corner[2]] - position[corner[0]];
    const Vec3 c = position[corner[3]] - position[corner[0]];
    return a.cross(b).dot(c) / 6.0;
}

Vec3 zone_centroid(const Model& model, Row zone) {
    const auto& corner = model.zones.gridpoints[zone];
    const auto& position = model.gridpoints.position;
    return 0.25 * (position[corner[0]] + position[corner[1]] + position[corner[2]] + position[corner[3]]);
}

Vec3 principal_stresses(const Model& model, Row zone) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(matrix_of(model.zones.stress[zone]), Eigen::EigenvaluesOnly);
    return solver.eigenvalues(); // ascending: compression is negative
}

std::pair<Vec3, Mat3> principal_axes(const Model& model, Row zone) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(matrix_of(model.zones.stress[zone]));
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Vec3 gridpoint_velocity(const Model& model, Row gridpoint) {
    const auto& blocks = model.blocks;
    const Row b = model.gridpoints.block[gridpoint];
    if (blocks.deformable[b]) return model.gridpoints.velocity[gridpoint];
    return blocks.velocity[b] +
           blocks.rotational_velocity[b].cross(model.gridpoints.position[gridpoint] - blocks.centroid[b]);
}

Vec3 block_centroid(const Model& model, Row block) {
    const auto& blocks = model.blocks;
    if (!blocks.deformable[block]) return blocks.centroid[block];
    // Relative to a gridpoint, to keep numbers small.
    const Vec3 origin = model.gridpoints.position[blocks.gridpoints[block].first];
    const Span zones = blocks.zones[block];
    Vec3 sum = Vec3::Zero();
    double volume = 0;
    for (Row z = zones.first; z < zones.end(); ++z) {
        const double part = zone_volume(model, z);
        sum += part * (zone_centroid(model, z) - origin);
        volume += part;
    }
    return volume > 0 ? Vec3(origin + sum / volume) : blocks.centroid[block];
}

Vec3 block_velocity(const Model& model, Row block) {
    return model.blocks.deformable[block] ? gridpoint_mean(model, block, model.gridpoints.velocity)
                                          : model.blocks.velocity[block];
}

Vec3 block_displacement(const Model& model, Row block) {
    return model.blocks.deformable[block] ? gridpoint_mean(model, block, model.gridpoints.displacement)
                                          : model.blocks.displacement[block];
}

Vec3 block_force(const Model& model, Row block) {
    return model.blocks.deformable[block] ? gridpoint_sum(model, block, model.gridpoints.force)
                                          : model.blocks.force[block];
}

Vec3 block_load(const Model& model, Row block) {
    return model.blocks.deformable[block] ? gridpoint_sum(model, block, model.gridpoints.load)
                                          : model.blocks.load[block];
}

Vec3 unbalanced_force(const Model& model, Row block) {
    return block_force(model, block) + block_load(model, block) + model.blocks.mass[block] * model.settings.gravity;
}

Vec3 unbalanced_at_gridpoint(const Model& model, Row gridpoint) {
    const auto& g = model.gridpoints;
    return g.force[gridpoint] + g.load[gridpoint] + g.mass[gridpoint] * model.settings.gravity;
}

} // namespace kaya
