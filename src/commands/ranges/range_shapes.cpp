// Range elements that are places in space.
#include "commands/ranges/range_tests.hpp"

#include "base/diagnostic.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {

using lang::RangeElement;

namespace {

template <int axis> RangeTest along_axis(const RangeElement& e, RangeContext& context) {
    // One value selects a plane, with tolerance for a small motion under load.
    constexpr double plane_slack = 100; // a ten-thousandth of the model's size
    const double slack = context.tolerance * (e.low == e.high ? plane_slack : 1);
    const double low = std::min(e.low, e.high) - slack;
    const double high = std::max(e.low, e.high) + slack;
    return on_place(context, [=](const Vec3& p) { return p[axis] >= low && p[axis] <= high; });
}

RangeTest in_box(const RangeElement& e, RangeContext& context) {
    const Vec3 slack = Vec3::Constant(context.tolerance);
    const Vec3 low = e.centre.cwiseMin(e.end2) - slack, high = e.centre.cwiseMax(e.end2) + slack;
    return on_place(
        context, [=](const Vec3& p) { return (p.array() >= low.array()).all() && (p.array() <= high.array()).all(); });
}

RangeTest by_plane(const RangeElement& e, RangeContext& context) {
    const Vec3 normal = e.normal.normalized(), origin = e.centre;
    const double slack = context.tolerance, limit = e.distance + slack;
    const int side = e.side;
    return on_place(context, [=](const Vec3& p) {
        const double height = normal.dot(p - origin);
        if (side > 0) return height >= -slack;
        if (side < 0) return height <= slack;
        return std::abs(height) <= limit;
    });
}

RangeTest in_sphere(const RangeElement& e, RangeContext& context) {
    const Vec3 centre = e.centre;
    const double inner = e.radius1 - context.tolerance, outer = e.radius2 + context.tolerance;
    return on_place(context, [=](const Vec3& p) {
        const double distance = (p - centre).norm();
        return distance >= inner && distance <= outer;
    });
}

RangeTest in_cylinder(const RangeElement& e, RangeContext& context) {
    const Vec3 end1 = e.centre;
    const double length = (e.end2 - e.centre).norm();
    if (length <= context.tolerance) throw Diagnostic("the two ends of the cylinder are the same point").at(e.place);
    const Vec3 axis = (e.end2 - e.centre) / length;
    const double inner = e.radius1 - context.tolerance, outer = e.radius2 + context.tolerance,
                 slack = context.tolerance;
    return on_place(context, [=](const Vec3& p) {
        const double along = axis.dot(p - end1);
        const double distance = (p - end1 - along * axis).norm();
        return along >= -slack && along <= length + slack && distance >= inner && distance <= outer;
    });
}

/// A plane figure in its own axes: two along the plane, one across.
struct FigurePlane {
    Vec3 origin, along, across, normal;

    Eigen::Vector2d flat(const Vec3& p) const { return {along.dot(p - origin), across.dot(p - origin)}; }
    double height(const Vec3& p) const { return std::abs(normal.dot(p - origin)); }
};

FigurePlane plane_of(const Vec3& origin, const Vec3& along, const Vec3& normal) {
    const Vec3 first = along.normalized();
    return {origin, first, normal.normalized().cross(first), normal.normalized()};
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d edge = b - a;
    const double length2 = edge.squaredNorm();
    const double share = length2 > 0 ? std::clamp(edge.dot(p - a) / length2, 0.0, 1.0) : 0;
    return (p - a - share * edge).norm();
}

/// Inside, or within the tolerance of the outline. Counts the edges crossed by a ray along the first axis.
bool inside_outline(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p, double tolerance) {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
        if (distance_to_segment(p, a, b) <= tolerance) return true;
        if ((a[1] > p[1]) == (b[1] > p[1])) continue;
        if (p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
    }
    return inside;
}

RangeTest in_polygon(const RangeElement& e, RangeContext& context) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < e.vertices.size(); ++i)
        normal += (e.vertices[i] - e.vertices[0]).cross(e.vertices[i + 1] - e.vertices[0]);
    const FigurePlane plane = plane_of(e.vertices[0], e.vertices[1] - e.vertices[0], normal);
    std::vector<Eigen::Vector2d> outline;
    for (const Vec3& vertex : e.vertices) outline.push_back(plane.flat(vertex));
    const double slack = context.tolerance, far = e.distance + slack;
    return on_place(context, [=](const Vec3& p) {
        return plane.height(p) <= far && inside_outline(outline, plane.flat(p), slack);
    });
}

RangeTest in_ellipse(const RangeElement& e, RangeContext& context) {
    const Vec3 one = e.end2, two = e.normal;
    const FigurePlane plane = plane_of(e.centre, one, one.cross(two));
    Eigen::Matrix2d axes;
    axes << plane.flat(e.centre + one), plane.flat(e.centre + two);
    const Eigen::Matrix2d inverse = axes.inverse();
    const double slack = context.tolerance, far = e.distance + slack;
    const double edge = 1 + slack / std::min(one.norm(), two.norm());
    return on_place(context,
                    [=](const Vec3& p) { return plane.height(p) <= far && (inverse * plane.flat(p)).norm() <= edge; });
}

RangeTest by_ground(const RangeElement& e, RangeContext& context) {
    if (!context.extras.ground) throw std::logic_error("a range of a ground surface without a reader");
    try {
        const auto ground = std::make_shared<Ground>(context.extras.ground(e.name));
        if (!e.centre.isZero()) ground->move(e.centre);
        const double side = e.side, edge = context.tolerance;
        return on_place(context, [ground, side, edge](const Vec3& p) {
            const auto height = ground->height(p.x(), p.y());
            return height && side * (p.z() - *height) >= -edge;
        });
    } catch (Diagnostic& wrong) {
        wrong.at(e.place);
        throw;
    }
}

RangeTest by_orientation(const RangeElement& e, RangeContext& context) {
    // As wide as rounding makes equal normals different.
    const double least = std::cos(e.radius1 * std::numbers::pi / 180) - 1e-9;
    const auto passes = [normal = e.normal, least](const Vec3& n) {
        return std::abs(n.dot(normal)) >= least * n.norm();
    };
    switch (context.kind) {
    case ObjectKind::face:
        return [passes](const Model& m, ObjectKind, Row row) { return passes(face_area_vector(m, row)); };
    case ObjectKind::triangle:
        return [passes](const Model& m, ObjectKind, Row row) { return passes(triangle_area_vector(m, row)); };
    case ObjectKind::contact:
    case ObjectKind::sub_contact:
        return [passes](const Model& m, ObjectKind kind, Row row) {
            return passes(m.contacts.normal[contact_of(m, kind, row)]);
        };
    default: break;
    }
    throw Diagnostic(fmt::format("'orientation' picks faces and contacts, but this command acts on {}",
                                 info_of(context.kind).plural))
        .at(e.place);
}

using Kind = RangeElement::Kind;
constexpr std::array place_tests{
    RangeEntry{Kind::x, along_axis<0>},      RangeEntry{Kind::y, along_axis<1>},
    RangeEntry{Kind::z, along_axis<2>},      RangeEntry{Kind::box, in_box},
    RangeEntry{Kind::plane, by_plane},       RangeEntry{Kind::sphere, in_sphere},
    RangeEntry{Kind::cylinder, in_cylinder}, RangeEntry{Kind::polygon, in_polygon},
    RangeEntry{Kind::ellipse, in_ellipse},   RangeEntry{Kind::ground, by_ground},
};
constexpr std::array face_tests{RangeEntry{Kind::orientation, by_orientation}};

} // namespace

std::span<const RangeEntry> tests_of_places() { return place_tests; }
std::span<const RangeEntry> tests_of_faces() { return face_tests; }

} // namespace kaya
