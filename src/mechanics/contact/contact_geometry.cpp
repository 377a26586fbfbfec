#include "mechanics/contact/contact_geometry.hpp"

#include "geometry/overlay/polygon_overlay.hpp"
#include "mechanics/contact/corner_contact.hpp"
#include "mechanics/contact/face_joint.hpp"
#include "mechanics/contact/surface_shares.hpp"
#include "mechanics/shape/corner_joints.hpp"
#include "mechanics/shape/overlap_patch.hpp"
#include "mechanics/shape/search_scratch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

/// Faces are parallel within this angle (2 degrees); beyond it a block rests on an edge or a corner, which owns its share of the block's
/// surface instead of a common area. Existing contacts keep their type for another half a degree: without this hysteresis a contact near
/// the limit would switch type every step and shake its load.
constexpr double cos_of_flat = 0.9993908270190958, cos_of_still_flat = 0.9990482215818578,
                 cos_of_flat_again = 0.9996573249755573;

double flat_limit(const Model& model, Row old) {
    if (old == no_row) return cos_of_flat;
    return model.contacts.type[old] == ContactType::face_face ? cos_of_still_flat : cos_of_flat_again;
}

/// In parts of a block's margin: points closer than this coincide, and common areas narrower than this are dropped. Blocks of a pile
/// overlap a little, and so do their edges and corners; such contacts would carry nothing at full cost.
constexpr double coincidence = 2e-5, narrowest = 1e-2;
/// Two faces with a common area below this many least contact areas are treated as corners and edges.
constexpr double least_joint = 10;
constexpr double least_part = 0.01; ///< see ContactPlane::least_area
/// In parts of the margin: another axis must be better than the present one by this much.
constexpr double persistence = 0.25;

/// Edge length of sub-contacts in the overlay; 0: none given.
double edge_between(const Model& model, Row block1, Row block2) {
    const double length = length_between(model, block1, block2);
    return std::isinf(length) ? 0 : length;
}

/// The outline of a rigid block's face, in order: its triangles form a fan.
void take_outline(const FlatFace& face, std::vector<Vec2>& outline) {
    const auto& triangles = face.mesh.triangles;
    outline.clear();
    if (triangles.empty()) return;
    outline.push_back(face.mesh.points[triangles[0][0]]);
    outline.push_back(face.mesh.points[triangles[0][1]]);
    for (const auto& t : triangles) outline.push_back(face.mesh.points[t[2]]);
}

/// `facetri radial8` asks for a place in the middle of each edge, too.
void add_middles(std::vector<Vec2>& polygon) {
    std::vector<Vec2> finer;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        finer.push_back(polygon[i]);
        finer.push_back(0.5 * (polygon[i] + polygon[(i + 1) % polygon.size()]));
    }
    polygon = finer;
}

/// Distance of fine sub-contacts over the diameter of a joint that turns, whose sum of friction is within 1 % then; and over the width of one
/// that bends, twice its area over its diameter: the moment at which a bond tears is within 5 %. Slivers count as wide as this part of
/// their diameter.
constexpr double fine_spacing = 0.1, least_width = 0.25;

double fine_edge(const std::vector<Vec2>& polygon, FinePlaces fine) {
    if (fine == FinePlaces::none) return 0;
    double square = 0, doubled = 0; // of the greatest distance of two corners; the area
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 a = polygon[i] - polygon[0], next = polygon[(i + 1) % polygon.size()] - polygon[0];
        doubled += a.x() * next.y() - a.y() * next.x();
        for (const Vec2& b : polygon) square = std::max(square, (polygon[i] - b).squaredNorm());
    }
    const double diameter = std::sqrt(square);
    return fine_spacing *
           (fine == FinePlaces::turns ? diameter : std::max(std::abs(doubled) / diameter, least_width * diameter));
}

/// Sub-contacts of two faces of rigid blocks: they depend on the common polygon, not on the triangulation of the faces.
bool intersect_rigid_faces(const Model& model, const Surfaces& surfaces, ContactGeometry& geometry, double margin,
                           double tolerance, FinePlaces fine, SearchScratch& scratch) {
    const PlaneAxes axes = axes_of(geometry.normal);
    const Row block1 = model.faces.block[geometry.face1], block2 = model.faces.block[geometry.face2];
    const Vec3 origin = model.blocks.centroid[block2]; // keeps coordinates small
    auto& [face1, face2] = scratch.faces;
    auto& [outline1, outline2] = scratch.outlines;
    auto& common = scratch.common;
    auto& found = scratch.found;
    face1.project(model, surfaces, geometry.face1, axes, origin);
    face2.project(model, surfaces, geometry.face2, axes, origin);
    take_outline(face1, outline1);
    take_outline(face2, outline2);
    common_polygon(outline1, outline2, tolerance, common, scratch.overlay);
    if (common.empty()) return false;
    const auto middles = [&](Row block) { return model.blocks.face_triangles[block] == FaceTriangles::radial_8; };
    if (middles(block1) || middles(block2)) add_middles(common);
    if (stands_on_corners(model, block1, block2)) corners_of_polygon(common, found);
    else
        points_of_polygon(common, shorter_length(edge_between(model, block1, block2), fine_edge(common, fine)),
                          tolerance, found, scratch.overlay);
    bool near = false;
    for (const auto& p : found.points) {
        ContactPoint& point = geometry.points.add();
        const int corner1 = face1.corner_at(p.place, 2 * tolerance), corner2 = face2.corner_at(p.place, 2 * tolerance);
        point.side1 = face1.attach_corner_or_place(p.place, corner1);
        point.side2 = face2.attach_corner_or_place(p.place, corner2);
        const Vec3 x1 = attached_position(model, point.side1), x2 = attached_position(model, point.side2);
        point.position = 0.5 * (x1 + x2);
        point.gap = geometry.normal.dot(x2 - x1);
        point.area = p.area;
        const bool inside = &p - found.points.data() >= static_cast<std::ptrdiff_t>(common.size());
        point.type = corner1 >= 0   ? SubContactType::vertex_face
                     : corner2 >= 0 ? SubContactType::face_vertex
                     : inside       ? SubContactType::face_face
                                    : SubContactType::edge_edge;
        near = near || point.gap < margin;
        geometry.area += point.area;
    }
    if (!near) return false;
    geometry.type = ContactType::face_face;
    geometry.position.setZero();
    for (const auto& point : geometry.points) geometry.position += point.area / geometry.area * point.position;
    return true;
}

/// The contact type by the feature opposite to the face that gives the normal, or by the two edges that do.
ContactType type_of_rigid(const Model& model, const Surfaces& surfaces, const ContactPlane& geometry, Row block1,
                          Row block2, double tolerance) {
    if (geometry.reference == 0) return ContactType::edge_edge;
    const Row other = geometry.reference == 1 ? block2 : block1;
    const Vec3 towards =
        geometry.reference == 1 ? geometry.normal : Vec3(-geometry.normal); // lowest vertices along it touch
    const double low = lowest(surfaces.vertices(other), towards);
    int closed = 0;
    for (Row g = model.blocks.gridpoints[other].first; g < model.blocks.gridpoints[other].end(); ++g)
        closed += towards.dot(model.gridpoints.position[g]) <= low + tolerance;
    return closed == 1 ? ContactType::face_vertex : closed == 2 ? ContactType::face_edge : ContactType::face_face;
}

/// Whether the projection of a point along the normal lies inside a face; returns the triangle's gridpoints and weights.
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
        const std::array<double, 3> w{cross(c[1], c[2]) / whole, cross(c[2], c[0]) / whole, cross(c[0], c[1]) / whole};
        if (w[0] < -1e-9 || w[1] < -1e-9 || w[2] < -1e-9) continue;
        attachment.gridpoints = g;
        attachment.weights = w;
        return true;
    }
    return false;
}

Attachment on_edge(const std::array<Row, 2>& ends, double t) { return {{ends[0], ends[1], ends[1]}, {1 - t, t, 0}}; }

/// The least area of a contact of zoned blocks at corners and edges: a sharp tip has nearly none. At most the area of the gridpoints there,
/// which on soft ground of large blocks would be too stiff.
double least_area_of(const SurfaceShares& shares, const ContactGeometry& geometry, Row block1, Row block2,
                     double least) {
    double area = 0;
    for (const auto& point : geometry.points)
        area = std::max(area, std::min({least, shares.whole_of_side(block1, point.side1),
                                        shares.whole_of_side(block2, point.side2)}));
    return area;
}

/// Sums over the points of a contact. Their total area is at most `most` and at least `least`.
bool complete_geometry(ContactGeometry& geometry, double most, double least) {
    if (geometry.points.size() == 0) return false;
    double whole = 0;
    for (const auto& point : geometry.points) whole += point.area;
    const double wanted = std::max(std::min(whole, most), least);
    for (auto& point : geometry.points)
        point.area = whole > 0 ? point.area * (wanted / whole) : wanted / static_cast<double>(geometry.points.size());
    Vec3 centre = Vec3::Zero();
    for (const auto& point : geometry.points) {
        geometry.area += point.area;
        centre += point.area * point.position;
    }
    geometry.position = centre / geometry.area;
    return geometry.area > 0;
}

/// The area of a face that the other block covers, projected along the face normal.
double covered_area(const Model& model, const Surfaces& surfaces, Row face, Row other, const PlaneAxes& axes,
                    const Vec3& out, double tolerance, SearchScratch& scratch) {
    auto& [own, above] = scratch.faces;
    const Vec3 origin = model.gridpoints.position[model.triangles.gridpoints[model.faces.triangles[face].first][0]];
    own.project(model, surfaces, face, axes, origin);
    double area = 0;
    const Span faces = model.blocks.faces[other];
    for (Row f = faces.first; f < faces.end(); ++f) {
        if (surfaces.normal(f).dot(out) > -0.01) continue; // looks the other way, or along
        above.project(model, surfaces, f, axes, origin);
        overlay(own.mesh, above.mesh, tolerance, 0, scratch.found, scratch.overlay);
        for (const auto& point : scratch.found.points) area += point.area;
    }
    return area;
}

/// A block on a face of the other block, without a face parallel to it: its vertices over the face, and its edges where they cross the face
/// outline.
bool project_on_face(const Model& model, const Surfaces& surfaces, ContactGeometry& geometry, Row block1, Row block2,
                     double margin, double tolerance) {
    const SurfaceShares shares(model, surfaces);
    const bool face_of_first = geometry.reference == 1;
    const Row face = face_of_first ? geometry.face1 : geometry.face2;
    const Row own = face_of_first ? block1 : block2, other = face_of_first ? block2 : block1;
    const Vec3 out = face_of_first ? geometry.normal : Vec3(-geometry.normal); // of the face
    const PlaneAxes axes = axes_of(geometry.normal);
    const auto& x = model.gridpoints.position;
    const auto add = [&](const Attachment& on_own, const Attachment& on_other, SubContactType type, double area) {
        const Vec3 lower = attached_position(model, on_own), upper = attached_position(model, on_other);
        ContactPoint point;
        point.gap = out.dot(upper - lower);
        if (point.gap > margin) return;
        point.side1 = face_of_first ? on_own : on_other;
        point.side2 = face_of_first ? on_other : on_own;
        point.position = 0.5 * (lower + upper);
        point.type = type;
        point.area = area;
        for (const auto& there : geometry.points)
            if ((there.position - point.position).squaredNorm() <= tolerance * tolerance) return;
        geometry.points.add() = point;
    };
    const Span span = model.blocks.gridpoints[other];
    for (Row g = span.first; g < span.end(); ++g) {
        Attachment on_face;
        if (inside_face(model, face, axes, x[g], on_face))
            add(on_face, {{g, g, g}, {1, 0, 0}},
                face_of_first ? SubContactType::face_vertex : SubContactType::vertex_face,
                shares.of_vertex(other, g, -out));
    }

    const auto flat = [&](Row from, Row to) {
        const Vec3 d = x[to] - x[from];
        return Vec2(d.dot(axes.u), d.dot(axes.v));
    };
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
    for (const auto& e : surfaces.edges(other)) {
        const Vec2 along = flat(e.ends[0], e.ends[1]);
        for (const auto& o : surfaces.edges(own)) {
            if (o.faces[0] != face && o.faces[1] != face) continue; // of the outline
            const Vec2 side = flat(o.ends[0], o.ends[1]), between = flat(e.ends[0], o.ends[0]);
            const double crossed = cross(along, side);
            if (std::abs(crossed) <= 1e-9 * along.norm() * side.norm()) continue;
            const double t = cross(between, side) / crossed, s = cross(between, along) / crossed;
            if (t < 0 || t > 1 || s < 0 || s > 1) continue;
            add(on_edge(o.ends, s), on_edge(e.ends, t), SubContactType::edge_edge,
                std::min(shares.of_edge(own, o.ends, out), shares.of_edge(other, e.ends, -out)));
        }
    }
    geometry.type = geometry.points.size() == 1 && geometry.points[0].type != SubContactType::edge_edge
                        ? ContactType::face_vertex
                        : ContactType::face_edge;
    return geometry.points.size() > 0;
}

/// Two edges that cross.
bool join_edges(const Model& model, const SurfaceShares& shares, ContactGeometry& geometry, const Separation& s,
                Row block1, Row block2, double margin) {
    const auto& x = model.gridpoints.position;
    const Vec3 d1 = x[s.edge1[1]] - x[s.edge1[0]], d2 = x[s.edge2[1]] - x[s.edge2[0]];
    const Vec3 between = x[s.edge2[0]] - x[s.edge1[0]];
    const double a = d1.dot(d1), b = d1.dot(d2), c = d2.dot(d2);
    const double determinant = a * c - b * b;
    if (determinant <= 1e-12 * a * c) return false;
    const double t1 = (d1.dot(between) * c - d2.dot(between) * b) / determinant;
    const double t2 = (d1.dot(between) * b - d2.dot(between) * a) / determinant;
    if (t1 < -1e-9 || t1 > 1 + 1e-9 || t2 < -1e-9 || t2 > 1 + 1e-9) return false;
    ContactPoint point;
    point.side1 = on_edge(s.edge1, t1);
    point.side2 = on_edge(s.edge2, t2);
    const Vec3 x1 = x[s.edge1[0]] + t1 * d1, x2 = x[s.edge2[0]] + t2 * d2;
    point.position = 0.5 * (x1 + x2);
    point.gap = geometry.normal.dot(x2 - x1);
    if (point.gap > margin) return false;
    point.type = SubContactType::edge_edge;
    point.area =
        std::min(shares.of_edge(block1, s.edge1, geometry.normal), shares.of_edge(block2, s.edge2, -geometry.normal));
    geometry.type = ContactType::edge_edge;
    geometry.points.add() = point;
    return true;
}

/// Blocks with zones on corners and edges.
bool contact_at_corners(const Model& model, const Surfaces& surfaces, ContactGeometry& geometry, const Separation& s,
                        Row block1, Row block2, double margin, double tolerance, double least, SearchScratch& scratch) {
    const SurfaceShares shares(model, surfaces);
    double most = std::numeric_limits<double>::infinity();
    if (geometry.reference == 0) {
        join_edges(model, shares, geometry, s, block1, block2, margin);
    } else if (project_on_face(model, surfaces, geometry, block1, block2, margin, tolerance)) {
        const bool first = geometry.reference == 1;
        most = covered_area(model, surfaces, first ? geometry.face1 : geometry.face2, first ? block2 : block1,
                            axes_of(geometry.normal), first ? geometry.normal : Vec3(-geometry.normal), tolerance,
                            scratch);
    }
    if (geometry.points.size() == 0) {
        if (!find_corner_contact(model, surfaces, block1, block2, s.distance, geometry, scratch.overlap)) return false;
        ContactPoint& point = geometry.points[0];
        point.area = std::min(shares.of_side(block1, point.side1, geometry.normal),
                              shares.of_side(block2, point.side2, -geometry.normal));
    }
    return complete_geometry(geometry, most, least_area_of(shares, geometry, block1, block2, least));
}

} // namespace

double narrowest_contact(const Model& model, Row block1, Row block2) {
    return narrowest * std::min(model.blocks.margin[block1], model.blocks.margin[block2]);
}

bool find_geometry(const Model& model, const Surfaces& surfaces, Row block1, Row block2, Row old, FinePlaces fine,
                   double margin, ContactGeometry& geometry, SearchScratch& scratch) {
    // A block's margin is a small part of its size.
    const double size = std::min(model.blocks.margin[block1], model.blocks.margin[block2]);
    const double tolerance = coincidence * size, sliver = narrowest_contact(model, block1, block2);
    const double flat = flat_limit(model, old);
    const Separation separation =
        find_separation(model, surfaces, block1, block2,
                        {margin, 10 * tolerance, size, sliver, flat, persistence * size, old}, scratch.separation);
    if (separation.distance > margin || separation.normal.isZero(0)) return false;

    geometry.normal = separation.normal;
    geometry.reference = separation.face1 != no_row ? 1 : separation.face2 != no_row ? 2 : 0;
    geometry.face1 = separation.face1;
    geometry.face2 = separation.face2;
    geometry.area = 0;
    geometry.points.clear();
    geometry.kind = ContactKind::joint;
    const bool flat_faces = geometry.reference != 0 && separation.cosine > flat;
    const double least = least_part * std::min(surfaces.mean_face_area(block1), surfaces.mean_face_area(block2));
    if (!model.blocks.deformable[block1] && !model.blocks.deformable[block2]) {
        geometry.least_area = least;
        // An overlap contact stays one while the blocks are near; re-created it would start late, with an impact.
        const bool overlaps = old != no_row && model.contacts.kind[old] == ContactKind::overlap;
        if (flat_faces && separation.apart_sideways && !overlaps) return false;
        if (flat_faces) {
            (geometry.reference == 1 ? geometry.face2 : geometry.face1) = separation.opposite;
            geometry.lie_on_faces(model, block1, block2, surfaces.normal(geometry.face1),
                                  surfaces.normal(geometry.face2));
            const bool found = intersect_rigid_faces(model, surfaces, geometry, margin, tolerance, fine, scratch);
            if (found && geometry.area >= least_joint * geometry.least_area) return true;
            if (!found && !overlaps) return false;
            // An approaching block with less common area meets an edge or a corner: a block that slides across the lip left by the closure
            // of its joint meets no face there.
            if (old == no_row && geometry.area < geometry.least_area)
                (geometry.reference == 1 ? geometry.face2 : geometry.face1) = no_row;
            geometry.points.clear();
        }
        geometry.kind = ContactKind::overlap;
        geometry.type = type_of_rigid(model, surfaces, geometry, block1, block2, tolerance);
        geometry.area = 0;
        geometry.gap = separation.distance;
        return true;
    }
    if (flat_faces) {
        if (separation.apart_sideways) return false; // an edge or a corner next to another
        const ContactPlane of_one_face = geometry;
        (geometry.reference == 1 ? geometry.face2 : geometry.face1) = separation.opposite;
        geometry.lie_on_faces(model, block1, block2, surfaces.normal(geometry.face1), surfaces.normal(geometry.face2));
        const double edge = edge_between(model, block1, block2);
        if (!intersect_faces(model, surfaces, geometry, {separation.cosine, margin, tolerance, edge}, scratch))
            return false;
        // Joints of cut rock keep their kind; approaching bodies with so small a common area rest on a corner or an edge.
        const bool arrives = old == no_row ? std::abs(separation.distance) > tolerance
                                           : model.contacts.type[old] != ContactType::face_face;
        if (!arrives || geometry.area >= least) return true;
        static_cast<ContactPlane&>(geometry) = of_one_face;
        geometry.points.clear();
    }
    return contact_at_corners(model, surfaces, geometry, separation, block1, block2, margin, tolerance, least, scratch);
}

} // namespace kaya
