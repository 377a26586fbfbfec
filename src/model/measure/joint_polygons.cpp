#include "model/measure/joint_polygons.hpp"

#include "geometry/polyhedra/kept_part.hpp"
#include "model/measure/joint_opening.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

namespace kaya {

namespace {

using Polygon = std::vector<Vec3>; ///< convex

std::vector<Vec3> places_of(const Model& model, std::span<const Row> gridpoints) {
    std::vector<Vec3> places;
    for (const Row g : gridpoints) places.push_back(model.gridpoints.position[g]);
    return places;
}

/// No corner turns back; corners on straight edges are none.
bool is_convex(const Polygon& polygon, const Vec3& normal) {
    const std::size_t count = polygon.size();
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 to = polygon[(k + 1) % count] - polygon[k], on = polygon[(k + 2) % count] - polygon[(k + 1) % count];
        if (to.cross(on).dot(normal) < -1e-9 * to.norm() * on.norm()) return false;
    }
    return true;
}

/// A face as convex parts: whole where it is a convex polygon without gridpoints inside, else its triangles.
std::vector<Polygon> parts_of(const Model& model, Row face) {
    const Span span = model.faces.triangles[face];
    const auto loop = face_outline(model, face);
    if (loop && static_cast<Row>(loop->size()) == span.count + 2) {
        Polygon whole = places_of(model, *loop);
        if (is_convex(whole, face_area_vector(model, face).normalized())) return {std::move(whole)};
    }
    std::vector<Polygon> all;
    for (Row t = span.first; t < span.end(); ++t) all.push_back(places_of(model, model.triangles.gridpoints[t]));
    return all;
}

struct Extent {
    Vec3 low, high;

    explicit Extent(const Polygon& polygon) : low(polygon[0]), high(polygon[0]) {
        for (const Vec3& corner : polygon) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    }
    bool apart(const Extent& other, double margin) const {
        return ((low - other.high).array() > margin).any() || ((other.low - high).array() > margin).any();
    }
};

/// Twice the area projected along the normal.
double doubled_area(std::span<const Vec3> polygon, const Vec3& normal) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 2; k < polygon.size(); ++k)
        sum += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
    return std::abs(sum.dot(normal));
}

/// The part of a polygon that lies above or below another one, along the normal of the joint.
Polygon common_part(const Polygon& a, const Polygon& b, const Vec3& normal) {
    Polygon polygon = a;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : b) middle += corner / static_cast<double>(b.size());
    for (std::size_t k = 0; k < b.size() && !polygon.empty(); ++k) {
        Vec3 outward = (b[(k + 1) % b.size()] - b[k]).cross(normal);
        if (outward.dot(b[k] - middle) < 0) outward = -outward;
        polygon = kept_part(polygon, [&](const Vec3& corner) { return outward.dot(corner - b[k]); });
    }
    return polygon;
}

} // namespace

std::optional<std::vector<Row>> face_outline(const Model& model, Row face) {
    std::map<Row, Row> next;
    std::vector<std::pair<Row, Row>> edges;
    const Span span = model.faces.triangles[face];
    for (Row t = span.first; t < span.end(); ++t) {
        const auto& corner = model.triangles.gridpoints[t];
        for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(corner[k], corner[(k + 1) % 3]);
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [from, to] : edges) {
        if (std::binary_search(edges.begin(), edges.end(), std::pair(to, from))) continue;
        if (!next.emplace(from, to).second) return std::nullopt;
    }
    if (next.empty()) return std::nullopt;
    std::vector<Row> loop;
    Row at = next.begin()->first;
    do {
        loop.push_back(at);
        const auto edge = next.find(at);
        if (edge == next.end() || loop.size() > next.size()) return std::nullopt;
        at = edge->second;
    } while (at != next.begin()->first);
    if (loop.size() != next.size()) return std::nullopt;
    return loop;
}

std::vector<std::vector<Vec3>> joint_polygons(const Model& model, Row contact) {
    const auto& contacts = model.contacts;
    if (contacts.face1[contact] == no_row || contacts.face2[contact] == no_row) return {};
    return common_polygons(model, contacts.face1[contact], contacts.face2[contact], contacts.normal[contact]);
}

std::vector<std::vector<Vec3>> common_polygons(const Model& model, Row face1, Row face2, const Vec3& normal) {
    std::vector<Polygon> parts;
    const auto& margins = model.blocks.margin;
    const double margin = margins[model.faces.block[face1]] + margins[model.faces.block[face2]];
    const auto second = parts_of(model, face2);
    const std::vector<Extent> extents(second.begin(), second.end());
    for (const Polygon& a : parts_of(model, face1)) {
        const Extent extent(a);
        for (std::size_t i = 0; i < second.size(); ++i) {
            if (extent.apart(extents[i], margin)) continue;
            const Polygon& b = second[i];
            auto part = common_part(a, b, normal);
            // Polygons that share only a corner or an edge have a sliver of rounding in common.
            if (doubled_area(part, normal) > 1e-9 * doubled_area(a, normal)) parts.push_back(std::move(part));
        }
    }
    return parts;
}

Row nearest_sub_contact(const Model& model, Row contact, const Vec3& place) {
    const Span span = model.contacts.sub_contacts[contact];
    Row best = span.first;
    double least = std::numeric_limits<double>::infinity();
    for (Row row = span.first; row < span.end(); ++row) {
        const bool moved = has_left_place(model, row);
        const Vec3 position = moved ? place_on_faces(model, row) : Vec3(model.sub_contacts.position[row]);
        const double distance = (position - place).squaredNorm();
        if (distance < least) least = distance, best = moved ? row_at_place(model, row) : row;
    }
    return best;
}

} // namespace kaya
