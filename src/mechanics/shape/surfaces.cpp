#include "mechanics/shape/surfaces.hpp"

#include "base/parallel.hpp"
#include "model/edit/ties.hpp"
#include "model/measure/cell_faces.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace kaya {

namespace {

/// Where the groups of four of each block begin; returns how many there are.
std::size_t number_groups(const Column<Span>& spans, std::vector<std::size_t>& first) {
    first.resize(spans.size() + 1);
    std::size_t next = 0;
    for (std::size_t b = 0; b < spans.size(); ++b) {
        first[b] = next;
        next += static_cast<std::size_t>((spans[b].count + lane_count - 1) / lane_count);
    }
    return first.back() = next;
}

/// By positions that are constant under motion to the last bit: those of a rigid block in its own axes.
double mean_face_area_of(const Model& model, Row block) {
    const Span faces = model.blocks.faces[block], triangles = model.blocks.triangles[block];
    const auto& x = model.gridpoints.reference;
    double sum = 0;
    for (Row t = triangles.first; t < triangles.end(); ++t) {
        const auto& g = model.triangles.gridpoints[t];
        sum += 0.5 * (x[g[1]] - x[g[0]]).cross(x[g[2]] - x[g[0]]).norm();
    }
    return faces.count > 0 ? sum / faces.count : 0;
}

} // namespace

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

bool Surfaces::knows(const Model& model, Row block) const {
    const auto& blocks = model.blocks;
    const Shape& shape = shapes_[block];
    return shape.block == blocks.id[block] && shape.gridpoints == blocks.gridpoints[block] &&
           shape.faces == blocks.faces[block] && shape.triangles == blocks.triangles[block];
}

void Surfaces::learn(const Model& model, Row block) {
    const auto& blocks = model.blocks;
    const auto& of_triangle = model.triangles.gridpoints;
    Shape& shape = shapes_[block];
    shape = {
        blocks.id[block], blocks.gridpoints[block], blocks.faces[block], blocks.triangles[block], {}, {}, {}, {}, 0};
    shape.mean_face_area = mean_face_area_of(model, block);
    edges_of(model, block, shape.edges);

    std::vector<Row>& corners = shape.corners;
    std::vector<std::size_t> first{0}; // of each face, in `corners`
    for (Row f = shape.faces.first; f < shape.faces.end(); ++f) {
        const Span span = model.faces.triangles[f];
        for (Row t = span.first; t < span.end(); ++t)
            corners.insert(corners.end(), of_triangle[t].begin(), of_triangle[t].end());
        const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(first.back());
        std::sort(begin, corners.end());
        corners.erase(std::unique(begin, corners.end()), corners.end());
        first.push_back(corners.size());
    }
    shape.corner_triangles.resize(static_cast<std::size_t>(shape.triangles.count));
    for (Row f = shape.faces.first; f < shape.faces.end(); ++f) {
        const std::size_t i = static_cast<std::size_t>(f - shape.faces.first);
        Plane& plane = planes_[f];
        plane.corners = {corners.data() + first[i], first[i + 1] - first[i]};
        const Span span = model.faces.triangles[f];
        auto* const triangles = shape.corner_triangles.data() + (span.first - shape.triangles.first);
        for (Row t = 0; t < span.count; ++t)
            for (int k = 0; k < 3; ++k)
                triangles[t][k] = static_cast<int>(
                    std::lower_bound(plane.corners.begin(), plane.corners.end(), of_triangle[span.first + t][k]) -
                    plane.corners.begin());
        plane.triangles = {triangles, static_cast<std::size_t>(span.count)};
    }
    learn_others(model, shape);
}

/// Along the other diagonals, where all triangles of a face are in pairs.
void Surfaces::learn_others(const Model& model, Shape& shape) {
    const bool rigid = !model.blocks.deformable[model.blocks.ids.row(shape.block)];
    shape.other_triangles = shape.corner_triangles;
    for (Row f = shape.faces.first; f < shape.faces.end(); ++f) {
        Plane& plane = planes_[f];
        plane.others = {};
        const Span span = model.faces.triangles[f];
        if (rigid ? span.count != 2 : partner_in_cell(model, span.first) == no_row) continue;
        auto* const others = shape.other_triangles.data() + (span.first - shape.triangles.first);
        for (std::size_t t = 0; t + 1 < plane.triangles.size(); t += 2) {
            const auto pair = other_diagonal(plane.triangles[t], plane.triangles[t + 1]);
            others[t] = pair[0];
            others[t + 1] = pair[1];
        }
        plane.others = {others, static_cast<std::size_t>(span.count)};
    }
}

void Surfaces::note_ties(const Model& model) {
    if (model.ties.size() == ties_) return; // all else is new when blocks are joined, cut or zoned
    ties_ = model.ties.size();
    tied_.clear();
    if (ties_ == 0) return;
    tied_.assign(model.faces.size(), 0);
    for (const Row face : tied_faces(model)) tied_[face] = 1;
}

void Surfaces::take_vertices(const Model& model, Row block) {
    const Span span = model.blocks.gridpoints[block];
    middles_[block] = block_centroid(model, block);
    Lanes3* group = vertices_.data() + first_vertices_[block];
    for (Row g = span.first; g < span.end(); g += lane_count, ++group)
        for (Row i = 0; i < lane_count; ++i) {
            const Vec3& x = model.gridpoints.position[std::min(g + i, span.end() - 1)];
            group->x[i] = x.x();
            group->y[i] = x.y();
            group->z[i] = x.z();
        }
}

/// No vertex of a rigid block lies farther out than the corners of the face; faces of deformed blocks are warped.
double Surfaces::reach_of(const Model& model, Row block, const Plane& plane) const {
    if (model.blocks.deformable[block]) return -lowest(vertices(block), -plane.normal);
    double reach = -std::numeric_limits<double>::infinity();
    for (const Row g : plane.corners) reach = std::max(reach, model.gridpoints.position[g].dot(plane.normal));
    return reach;
}

void Surfaces::take_planes(const Model& model, Row block) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Span span = model.blocks.faces[block];
    FourPlanes* group = four_planes_.data() + first_planes_[block];
    for (Row f = span.first; f < span.end(); f += lane_count, ++group) {
        *group = {four_times(Vec3(Vec3::Zero())), four_times(infinity)};
        for (Row i = 0; i < std::min<Row>(lane_count, span.end() - f); ++i) {
            Plane& plane = planes_[f + i];
            plane.normal = current_normal(model, f + i);
            plane.reach = plane.normal.isZero(0) ? infinity : reach_of(model, block, plane);
            group->normal.x[i] = plane.normal.x();
            group->normal.y[i] = plane.normal.y();
            group->normal.z[i] = plane.normal.z();
            group->reach[i] = plane.reach;
        }
    }
}

void Surfaces::update(const Model& model, const std::vector<Row>& blocks) {
    note_ties(model);
    planes_.resize(model.faces.size());
    shapes_.resize(model.blocks.size());
    middles_.resize(model.blocks.size());
    vertices_.resize(number_groups(model.blocks.gridpoints, first_vertices_));
    four_planes_.resize(number_groups(model.blocks.faces, first_planes_));
    for_chunks(blocks.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Row block = blocks[i];
            if (!knows(model, block)) learn(model, block);
            take_vertices(model, block);
            take_planes(model, block);
        }
    });
}

} // namespace kaya
