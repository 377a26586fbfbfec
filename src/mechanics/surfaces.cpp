#include "mechanics/surfaces.hpp"

#include "base/parallel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace kaya {

Vec3 current_normal(const Model& model, Row face) {
    Vec3 sum = Vec3::Zero();
    const Span span = model.faces.triangles[face];
    for (Row t = span.first; t < span.end(); ++t) {
        const auto& g = model.triangles.gridpoints[t];
        const Vec3& a = model.gridpoints.position[g[0]];
        sum += (model.gridpoints.position[g[1]] - a).cross(model.gridpoints.position[g[2]] - a);
    }
    const double length = sum.norm();
    return length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

void Surfaces::update(const Model& model, const std::vector<Row>& blocks) {
    planes_.resize(model.faces.size());
    edges_.resize(model.blocks.size());
    for_chunks(blocks.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Row block = blocks[i];
            const Span faces = model.blocks.faces[block], vertices = model.blocks.gridpoints[block];
            const Span triangles = model.blocks.triangles[block];
            EdgeList& edges = edges_[block];
            if (edges.block != model.blocks.id[block] || edges.gridpoints != vertices || edges.faces != faces ||
                edges.triangles != triangles) {
                edges_of(model, block, edges.list);
                edges.block = model.blocks.id[block];
                edges.gridpoints = vertices;
                edges.faces = faces;
                edges.triangles = triangles;
            }
            for (Row f = faces.first; f < faces.end(); ++f) {
                Plane& plane = planes_[f];
                plane.normal = current_normal(model, f);
                constexpr double infinity = std::numeric_limits<double>::infinity();
                plane.reach = plane.normal.isZero(0) ? infinity : -infinity;
                for (Row g = vertices.first; g < vertices.end(); ++g)
                    plane.reach = std::max(plane.reach, plane.normal.dot(model.gridpoints.position[g]));
            }
        }
    });
}

} // namespace kaya
