#include "mechanics/contact_geometry.hpp"

#include "geometry/overlay.hpp"
#include "mechanics/separation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

/// Faces more than this from the common plane touch with an edge or a vertex only.
constexpr double cos_of_flat = 0.8660254037844387; // 30 degrees
/// In parts of a block's margin: points that are one, and how narrow the common area of two faces may be. The blocks
/// of a pile overlap a little, and so do their edges and corners: those contacts would carry nothing and cost as much.
constexpr double coincidence = 2e-5, narrowest = 1e-2;

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

/// A face in the coordinates of the common plane.
struct FlatFace {
    PlaneMesh mesh; ///< its own triangles
    PlaneMesh radial; ///< those that contacts are made with, if they are others
    bool is_radial;
    std::vector<Row> rows; ///< the gridpoint of each point of its own

    void lay(const Model& model, Row face, const PlaneAxes& axes, const Vec3& origin) {
        const Span span = model.faces.triangles[face];
        rows.clear();
        for (Row t = span.first; t < span.end(); ++t)
            for (const Row g : model.triangles.gridpoints[t]) rows.push_back(g);
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        mesh.points.clear();
        for (const Row g : rows) {
            const Vec3 d = model.gridpoints.position[g] - origin;
            mesh.points.emplace_back(d.dot(axes.u), d.dot(axes.v));
        }
        mesh.triangles.clear();
        for (Row t = span.first; t < span.end(); ++t) {
            std::array<int, 3> triangle;
            for (int k = 0; k < 3; ++k)
                triangle[k] = static_cast<int>(
                    std::lower_bound(rows.begin(), rows.end(), model.triangles.gridpoints[t][k]) - rows.begin());
            mesh.triangles.push_back(triangle);
        }
        const FaceTriangles wanted = model.blocks.face_triangles[model.faces.block[face]];
        is_radial = wanted != FaceTriangles::fan;
        if (is_radial) radial = radial_mesh(mesh, wanted);
    }
    const PlaneMesh& laid() const { return is_radial ? radial : mesh; }

    Attachment attach(const Vec2& place, int vertex, int triangle, std::array<double, 3> weights) const {
        if (vertex >= 0 && vertex < static_cast<int>(rows.size()))
            return {{rows[vertex], rows[vertex], rows[vertex]}, {1, 0, 0}};
        if (is_radial) triangle = triangle_at(mesh, place, weights);
        Attachment a;
        for (int k = 0; k < 3; ++k) {
            a.gridpoints[k] = rows[mesh.triangles[triangle][k]];
            a.weights[k] = weights[k];
        }
        return a;
    }
};

/// Length of edges in the overlay that two blocks ask for; 0: none.
double edge_between(const Model& model, Row block1, Row block2) {
    const double a = model.blocks.face_edge[block1], b = model.blocks.face_edge[block2];
    return a > 0 && b > 0 ? std::min(a, b) : std::max(a, b);
}

/// Sub-contacts at the vertices of the overlay of two faces.
bool lay_faces(const Model& model, TouchGeometry& touch, bool rigid, double margin, double tolerance) {
    const PlaneAxes axes = axes_of(touch.normal);
    const Vec3 origin = model.gridpoints.position[model.triangles.gridpoints[model.faces.triangles[touch.face2].first][0]];
    static thread_local FlatFace face1, face2; // kept, since a search lays very many
    face1.lay(model, touch.face1, axes, origin);
    face2.lay(model, touch.face2, axes, origin);
    const double edge = edge_between(model, model.faces.block[touch.face1], model.faces.block[touch.face2]);
    Vec3 centre = Vec3::Zero();
    bool near = false;
    Overlay laid = overlay(face1.laid(), face2.laid(), tolerance, edge);
    touch.points.reserve(laid.points.size());
    if (rigid) balance_areas(laid);
    for (const auto& p : laid.points) {
        TouchPoint point;
        point.side1 = face1.attach(p.place, p.vertex1, p.triangle1, p.weights1);
        point.side2 = face2.attach(p.place, p.vertex2, p.triangle2, p.weights2);
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

Vec3 attached_position(const Model& model, const Attachment& side) {
    const auto& x = model.gridpoints.position;
    if (side.weights[0] == 1) return x[side.gridpoints[0]];
    return side.weights[0] * x[side.gridpoints[0]] + side.weights[1] * x[side.gridpoints[1]] +
           side.weights[2] * x[side.gridpoints[2]];
}

bool find_touch(const Model& model, const Surfaces& surfaces, Row block1, Row block2, double margin,
                TouchGeometry& touch) {
    // A block's margin is a small part of its size.
    const double size = std::min(model.blocks.margin[block1], model.blocks.margin[block2]);
    const double tolerance = coincidence * size, sliver = narrowest * size;
    const Separation separation =
        find_separation(model, surfaces, block1, block2, {margin, 10 * tolerance, sliver, cos_of_flat});
    if (separation.distance > margin || separation.normal.isZero(0)) return false;

    touch.normal = separation.normal;
    touch.reference = separation.face1 != no_row ? 1 : separation.face2 != no_row ? 2 : 0;
    touch.face1 = separation.face1;
    touch.face2 = separation.face2;
    touch.area = 0;
    touch.points.clear();
    if (touch.reference == 0) return lay_edges(model, touch, separation, block1, block2, margin);
    double cosine;
    const bool face_of_first = touch.reference == 1;
    const Row opposite = facing(model, surfaces, face_of_first ? block2 : block1,
                                face_of_first ? Vec3(-touch.normal) : touch.normal, cosine);
    if (cosine < cos_of_flat) return lay_vertices(model, touch, block1, block2, margin);
    if (separation.width <= sliver) return false; // an edge or a corner beside another
    (face_of_first ? touch.face2 : touch.face1) = opposite;
    const bool rigid = !model.blocks.deformable[block1] && !model.blocks.deformable[block2];
    return lay_faces(model, touch, rigid, margin, tolerance);
}

} // namespace kaya
