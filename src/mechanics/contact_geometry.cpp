#include "mechanics/contact_geometry.hpp"

#include "base/parallel.hpp"
#include "geometry/overlay.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

/// Faces more than this from the common plane touch with an edge or a vertex only.
constexpr double cos_of_flat = 0.8660254037844387; // 30 degrees

/// An axis that separates two convex blocks best, or along which they overlap least.
struct Separation {
    double distance = -std::numeric_limits<double>::infinity(); ///< negative: overlap
    Vec3 normal = Vec3::Zero();                                 ///< from block 1 to block 2
    Row face1 = no_row, face2 = no_row;
    std::array<Row, 2> edge1{no_row, no_row}, edge2{no_row, no_row};
};

struct Support {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

Support support(const Model& model, Row block, const Vec3& axis) {
    Support s;
    const Span span = model.blocks.gridpoints[block];
    for (Row g = span.first; g < span.end(); ++g) {
        const double h = axis.dot(model.gridpoints.position[g]);
        s.low = std::min(s.low, h);
        s.high = std::max(s.high, h);
    }
    return s;
}

/// Edges between faces of a block (not those between triangles of one face), each once.
std::vector<std::array<Row, 2>> edges_of(const Model& model, Row block) {
    std::vector<std::array<Row, 2>> edges;
    for (Row f = model.blocks.faces[block].first; f < model.blocks.faces[block].end(); ++f) {
        std::vector<std::array<Row, 2>> own;
        const Span span = model.faces.triangles[f];
        for (Row t = span.first; t < span.end(); ++t)
            for (int k = 0; k < 3; ++k) {
                const auto& g = model.triangles.gridpoints[t];
                const std::array<Row, 2> edge{std::min(g[k], g[(k + 1) % 3]), std::max(g[k], g[(k + 1) % 3])};
                const auto twin = std::find(own.begin(), own.end(), edge);
                if (twin == own.end()) own.push_back(edge);
                else own.erase(twin);
            }
        edges.insert(edges.end(), own.begin(), own.end());
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// Separating axes of two convex bodies: face normals, then cross products of edges (Gottschalk 1996).
/// `enough`: a separation at which the search may stop. An axis of two edges must beat the faces clearly:
/// faces of deformed blocks are a little warped, and their edges then seem to part what lies flat.
Separation find_separation(const Model& model, const Surfaces& surfaces, Row block1, Row block2, double enough,
                           double tie) {
    Separation best;
    const auto try_faces = [&](bool of_first) {
        const Row own = of_first ? block1 : block2, other = of_first ? block2 : block1;
        for (Row f = model.blocks.faces[own].first; f < model.blocks.faces[own].end(); ++f) {
            const Vec3& outward = surfaces.normal(f);
            if (outward.isZero()) continue;
            const double distance = support(model, other, outward).low - support(model, own, outward).high;
            if (distance > best.distance + (best.normal.isZero() ? 0 : tie))
                best = {distance, of_first ? outward : Vec3(-outward), of_first ? f : no_row,
                        of_first ? no_row : f, {no_row, no_row}, {no_row, no_row}};
            if (best.distance > enough) return;
        }
    };
    // The lower block (block 2) first: at a tie its face gives the normal.
    try_faces(false);
    if (best.distance <= enough) try_faces(true);
    if (best.distance > enough) return best;

    // Two faces on each other: no pair of edges can separate the blocks better.
    const Row block_other = best.face1 == no_row ? block1 : block2;
    const double sense = best.face1 == no_row ? 1 : -1;
    for (Row f = model.blocks.faces[block_other].first; f < model.blocks.faces[block_other].end(); ++f)
        if (sense * surfaces.normal(f).dot(best.normal) > 1 - 1e-9) return best;

    const auto edges1 = edges_of(model, block1), edges2 = edges_of(model, block2);
    const Vec3 towards = model.blocks.centroid[block2] - model.blocks.centroid[block1];
    for (const auto& e1 : edges1)
        for (const auto& e2 : edges2) {
            const Vec3 d1 = model.gridpoints.position[e1[1]] - model.gridpoints.position[e1[0]];
            const Vec3 d2 = model.gridpoints.position[e2[1]] - model.gridpoints.position[e2[0]];
            Vec3 axis = d1.cross(d2);
            const double length = axis.norm();
            if (length <= 1e-6 * d1.norm() * d2.norm()) continue;
            axis /= length;
            if (axis.dot(towards) < 0) axis = -axis;
            const double high1 = support(model, block1, axis).high;
            if (axis.dot(model.gridpoints.position[e1[0]]) < high1 - tie) continue; // not an outermost edge
            const double low2 = support(model, block2, axis).low;
            if (axis.dot(model.gridpoints.position[e2[0]]) > low2 + tie) continue;
            if (low2 - high1 > best.distance + (best.edge1[0] == no_row ? enough : tie)) {
                best = {low2 - high1, axis, no_row, no_row, e1, e2};
                if (best.distance > enough) return best;
            }
        }
    return best;
}

/// The face of a block that looks most against `direction`.
Row facing(const Model& model, const Surfaces& surfaces, Row block, const Vec3& direction, double& cosine) {
    Row best = no_row;
    cosine = -2;
    for (Row f = model.blocks.faces[block].first; f < model.blocks.faces[block].end(); ++f) {
        const double c = surfaces.normal(f).dot(direction);
        if (c > cosine + 1e-12) {
            cosine = c;
            best = f;
        }
    }
    return best;
}

struct PlaneAxes {
    Vec3 u, v;
};

PlaneAxes axes_of(const Vec3& normal) {
    int least = 0;
    normal.cwiseAbs().minCoeff(&least);
    const Vec3 u = normal.cross(Vec3::Unit(least)).normalized();
    return {u, normal.cross(u)};
}

/// A face in the coordinates of the common plane; `rows` gives the gridpoint of each point.
PlaneMesh flattened(const Model& model, Row face, const PlaneAxes& axes, const Vec3& origin, std::vector<Row>& rows) {
    PlaneMesh mesh;
    const Span span = model.faces.triangles[face];
    rows.clear();
    for (Row t = span.first; t < span.end(); ++t)
        for (const Row g : model.triangles.gridpoints[t]) rows.push_back(g);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (const Row g : rows) {
        const Vec3 d = model.gridpoints.position[g] - origin;
        mesh.points.emplace_back(d.dot(axes.u), d.dot(axes.v));
    }
    for (Row t = span.first; t < span.end(); ++t) {
        std::array<int, 3> triangle;
        for (int k = 0; k < 3; ++k)
            triangle[k] = static_cast<int>(
                std::lower_bound(rows.begin(), rows.end(), model.triangles.gridpoints[t][k]) - rows.begin());
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

Attachment attach(const PlaneMesh& mesh, const std::vector<Row>& rows, int vertex, int triangle,
                  const std::array<double, 3>& weights) {
    if (vertex >= 0) return {{rows[vertex], rows[vertex], rows[vertex]}, {1, 0, 0}};
    Attachment a;
    for (int k = 0; k < 3; ++k) {
        a.gridpoints[k] = rows[mesh.triangles[triangle][k]];
        a.weights[k] = weights[k];
    }
    return a;
}

/// Sub-contacts at the vertices of the overlay of two faces.
bool lay_faces(const Model& model, TouchGeometry& touch, bool rigid, double margin, double tolerance) {
    const PlaneAxes axes = axes_of(touch.normal);
    const Vec3 origin = model.gridpoints.position[model.triangles.gridpoints[model.faces.triangles[touch.face2].first][0]];
    std::vector<Row> rows1, rows2;
    const PlaneMesh mesh1 = flattened(model, touch.face1, axes, origin, rows1);
    const PlaneMesh mesh2 = flattened(model, touch.face2, axes, origin, rows2);
    Vec3 centre = Vec3::Zero();
    bool near = false;
    Overlay laid = overlay(mesh1, mesh2, tolerance);
    if (rigid) balance_areas(laid);
    for (const auto& p : laid.points) {
        TouchPoint point;
        point.side1 = attach(mesh1, rows1, p.vertex1, p.triangle1, p.weights1);
        point.side2 = attach(mesh2, rows2, p.vertex2, p.triangle2, p.weights2);
        const Vec3 x1 = attached_position(model, point.side1), x2 = attached_position(model, point.side2);
        point.position = 0.5 * (x1 + x2);
        point.gap = touch.normal.dot(x2 - x1);
        point.area = p.area;
        point.meeting = p.vertex1 >= 0   ? Meeting::vertex_face
                        : p.vertex2 >= 0 ? Meeting::face_vertex
                                         : Meeting::edge_edge;
        near = near || point.gap < margin;
        touch.area += point.area;
        centre += point.area * point.position;
        touch.points.push_back(point);
    }
    if (!near) return false;
    touch.position = centre / touch.area;
    touch.touch = Touch::face_face;
    return true;
}

/// Whether a point lies inside a face, seen along the normal; gives the triangle's gridpoints and weights.
bool inside_face(const Model& model, Row face, const PlaneAxes& axes, const Vec3& place, Attachment& attachment) {
    const Span span = model.faces.triangles[face];
    for (Row t = span.first; t < span.end(); ++t) {
        const auto& g = model.triangles.gridpoints[t];
        std::array<Vec2, 3> c;
        for (int k = 0; k < 3; ++k) {
            const Vec3 d = model.gridpoints.position[g[k]] - place;
            c[k] = {d.dot(axes.u), d.dot(axes.v)};
        }
        const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
        const double whole = cross(c[1] - c[0], c[2] - c[0]);
        if (whole == 0) continue;
        const std::array<double, 3> w{cross(c[1], c[2]) / whole, cross(c[2], c[0]) / whole,
                                      cross(c[0], c[1]) / whole};
        if (w[0] < -1e-9 || w[1] < -1e-9 || w[2] < -1e-9) continue;
        attachment.gridpoints = g;
        attachment.weights = w;
        return true;
    }
    return false;
}

double mean_face_area(const Model& model, Row block) {
    double area = 0;
    const Span span = model.blocks.triangles[block];
    for (Row t = span.first; t < span.end(); ++t) {
        const auto& g = model.triangles.gridpoints[t];
        const Vec3& a = model.gridpoints.position[g[0]];
        area += 0.5 * (model.gridpoints.position[g[1]] - a).cross(model.gridpoints.position[g[2]] - a).norm();
    }
    return area / model.blocks.faces[block].count;
}

/// Vertices of one block on a face of the other that is not parallel to any of its own. The contact has
/// no area of its own: it is given a hundredth of the mean face area, shared by its points.
bool lay_vertices(const Model& model, TouchGeometry& touch, Row block1, Row block2, double margin) {
    const bool face_of_first = touch.reference == 1;
    const Row face = face_of_first ? touch.face1 : touch.face2;
    const Row other = face_of_first ? block2 : block1;
    const double sense = face_of_first ? 1 : -1;
    const PlaneAxes axes = axes_of(touch.normal);
    const Span span = model.blocks.gridpoints[other];
    for (Row g = span.first; g < span.end(); ++g) {
        TouchPoint point;
        Attachment on_face;
        const Vec3& x = model.gridpoints.position[g];
        if (!inside_face(model, face, axes, x, on_face)) continue;
        point.gap = sense * touch.normal.dot(x - attached_position(model, on_face));
        if (point.gap > margin) continue;
        const Attachment vertex{{g, g, g}, {1, 0, 0}};
        point.side1 = face_of_first ? on_face : vertex;
        point.side2 = face_of_first ? vertex : on_face;
        point.position = 0.5 * (x + attached_position(model, on_face));
        point.meeting = face_of_first ? Meeting::face_vertex : Meeting::vertex_face;
        touch.points.push_back(point);
    }
    if (touch.points.empty()) return false;
    touch.area = 0.01 * 0.5 * (mean_face_area(model, block1) + mean_face_area(model, block2));
    touch.position = Vec3::Zero();
    for (auto& point : touch.points) {
        point.area = touch.area / static_cast<double>(touch.points.size());
        touch.position += point.position / static_cast<double>(touch.points.size());
    }
    touch.touch = touch.points.size() == 1 ? Touch::face_vertex : Touch::face_edge;
    return true;
}

/// Two edges that cross.
bool lay_edges(const Model& model, TouchGeometry& touch, const Separation& s, Row block1, Row block2, double margin) {
    const auto& x = model.gridpoints.position;
    const Vec3 d1 = x[s.edge1[1]] - x[s.edge1[0]], d2 = x[s.edge2[1]] - x[s.edge2[0]];
    const Vec3 between = x[s.edge2[0]] - x[s.edge1[0]];
    const double a = d1.dot(d1), b = d1.dot(d2), c = d2.dot(d2);
    const double determinant = a * c - b * b;
    if (determinant <= 1e-12 * a * c) return false;
    const double t1 = (d1.dot(between) * c - d2.dot(between) * b) / determinant;
    const double t2 = (d1.dot(between) * b - d2.dot(between) * a) / determinant;
    if (t1 < -1e-9 || t1 > 1 + 1e-9 || t2 < -1e-9 || t2 > 1 + 1e-9) return false;
    TouchPoint point;
    point.side1 = {{s.edge1[0], s.edge1[1], s.edge1[1]}, {1 - t1, t1, 0}};
    point.side2 = {{s.edge2[0], s.edge2[1], s.edge2[1]}, {1 - t2, t2, 0}};
    const Vec3 x1 = x[s.edge1[0]] + t1 * d1, x2 = x[s.edge2[0]] + t2 * d2;
    point.position = 0.5 * (x1 + x2);
    point.gap = touch.normal.dot(x2 - x1);
    if (point.gap > margin) return false;
    point.meeting = Meeting::edge_edge;
    point.area = touch.area = 0.01 * 0.5 * (mean_face_area(model, block1) + mean_face_area(model, block2));
    touch.position = point.position;
    touch.touch = Touch::edge_edge;
    touch.points.push_back(point);
    return true;
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

Surfaces::Surfaces(const Model& model) : normals_(model.faces.size()) {
    for_chunks(normals_.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = first; f < last; ++f) normals_[f] = current_normal(model, static_cast<Row>(f));
    });
}

Vec3 attached_position(const Model& model, const Attachment& side) {
    const auto& x = model.gridpoints.position;
    if (side.weights[0] == 1) return x[side.gridpoints[0]];
    return side.weights[0] * x[side.gridpoints[0]] + side.weights[1] * x[side.gridpoints[1]] +
           side.weights[2] * x[side.gridpoints[2]];
}

std::optional<TouchGeometry> find_touch(const Model& model, const Surfaces& surfaces, Row block1, Row block2,
                                        double margin) {
    const double size = std::cbrt(std::min(model.blocks.volume[block1], model.blocks.volume[block2]));
    const Separation separation = find_separation(model, surfaces, block1, block2, margin, 1e-6 * size);
    if (separation.distance > margin || separation.normal.isZero()) return std::nullopt;

    TouchGeometry touch{};
    touch.normal = separation.normal;
    touch.reference = separation.face1 != no_row ? 1 : separation.face2 != no_row ? 2 : 0;
    touch.face1 = separation.face1;
    touch.face2 = separation.face2;
    if (touch.reference == 0) {
        if (lay_edges(model, touch, separation, block1, block2, margin)) return touch;
        return std::nullopt;
    }
    double cosine;
    const bool face_of_first = touch.reference == 1;
    const Row opposite = facing(model, surfaces, face_of_first ? block2 : block1,
                                face_of_first ? Vec3(-touch.normal) : touch.normal, cosine);
    if (cosine >= cos_of_flat) {
        (face_of_first ? touch.face2 : touch.face1) = opposite;
        const bool rigid = !model.blocks.deformable[block1] && !model.blocks.deformable[block2];
        if (lay_faces(model, touch, rigid, margin, 1e-7 * size)) return touch;
        return std::nullopt;
    }
    if (lay_vertices(model, touch, block1, block2, margin)) return touch;
    return std::nullopt;
}

} // namespace kaya
