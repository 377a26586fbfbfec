#include "mechanics/supports/quiet_boundary.hpp"

#include "mechanics/common/elastic_constants.hpp"
#include "model/edit/ties.hpp"
#include "model/measure/cell_faces.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Pressure and shear wave speeds times density.
struct Impedance {
    double normal, shear;
};

Impedance impedance_of(const Model& model, const std::vector<ElasticConstants>& elastic, Row block) {
    const double density = model.materials.at(model.blocks.material[block]).density;
    const auto& [lambda, two_shear] = elastic[static_cast<std::size_t>(block)];
    return {std::sqrt(density * (lambda + two_shear)), std::sqrt(density * 0.5 * two_shear)};
}

/// Dashpot of a unit area with unit normal n: the parts of the full dashpot that the bits select.
Mat3 dashpot_of(const Impedance& impedance, const Vec3& n, std::uint8_t bits) {
    const Mat3 normal = impedance.normal * n * n.transpose();
    const Mat3 shear = impedance.shear * (Mat3::Identity() - n * n.transpose());
    Mat3 sum = Mat3::Zero();
    if (bits & quiet_normal) sum += normal;
    if (bits & quiet_shear) sum += shear;
    const Mat3 whole = normal + shear;
    for (int k = 0; k < 3; ++k)
        if (bits & (quiet_x << k)) sum(k, k) = whole(k, k);
    return sum;
}

} // namespace

QuietPoints quiet_points(const Model& model, const std::vector<ElasticConstants>& elastic) {
    QuietPoints points;
    const auto& triangles = model.triangles;
    const CellFaces faces(model, tied_faces(model));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Row block = model.faces.block[triangles.face[t]];
        if (triangles.quiet[t] == 0 || !model.blocks.deformable[block]) continue;
        if (points.index.empty()) points.index.assign(model.gridpoints.size(), no_row);
        const Row row = static_cast<Row>(t), partner = faces.partner(row);
        const bool both = partner != no_row && triangles.quiet[partner] == triangles.quiet[t];
        faces.for_parts(row, both, [&](const SurfacePart& part) {
            const auto& corner = part.corners;
            const auto& x = model.gridpoints.reference;
            const Vec3 area = triangle_area_vector(x[corner[0]], x[corner[1]], x[corner[2]]);
            const Mat3 third = part.share * area.norm() / 3 *
                               dashpot_of(impedance_of(model, elastic, block), area.normalized(), triangles.quiet[t]);
            for (const Row g : corner) {
                if (points.index[g] == no_row) {
                    points.index[g] = static_cast<Row>(points.dashpot.size());
                    points.dashpot.push_back(Mat3::Zero());
                }
                points.dashpot[points.index[g]] += third;
            }
        });
    }
    return points;
}

Vec3 quiet_force(const Mat3& dashpot, double mass, const Vec3& velocity, const Vec3& force, std::uint8_t fixed,
                 double step) {
    Mat3 system = mass * Mat3::Identity() + 0.5 * step * dashpot;
    Vec3 right = mass * velocity - 0.5 * step * (dashpot * velocity) + step * force;
    for (int k = 0; k < 3; ++k)
        if (fixed & (1 << k)) {
            system.row(k) = Vec3::Unit(k).transpose();
            right[k] = velocity[k];
        }
    const Vec3 after = system.inverse() * right;
    return -0.5 * (dashpot * (velocity + after));
}

} // namespace kaya
