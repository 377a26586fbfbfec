// Range elements that are places in space.
#include "commands/ranges/flat_figure.hpp"
#include "commands/ranges/range_tests.hpp"
#include "commands/ranges/surface_space.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/face_contact.hpp"
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
        return side * height >= -slack && std::abs(height) <= limit;
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

RangeTest in_polygon(const RangeElement& e, RangeContext& context) {
    const FigurePlane plane = plane_of(e.vertices[0], e.vertices[1] - e.vertices[0], area_vector(e.vertices));
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

/// The polygons of all sets of an element.
PolygonSet polygons_of(const RangeElement& e, const RangeContext& context) {
    if (!context.extras.surfaces) throw std::logic_error("a range of surfaces without the sets of the session");
    PolygonSet all;
    for (const auto& name : e.sets) {
        const PolygonSet* set = context.extras.surfaces(name);
        if (set == nullptr)
            throw Diagnostic(fmt::format("there is no set of surfaces named '{}'", name),
                             "make it before: geometry set 'name', geometry import 'file'")
                .at(e.place);
        all.insert(all.end(), set->begin(), set->end());
    }
    return all;
}

RangeTest by_crossings(const RangeElement& e, RangeContext& context) {
    const auto rays = std::make_shared<const SurfaceRays>(polygons_of(e, context), e.normal.normalized());
    if (e.side == 2)
        return on_place(context, [rays, wanted = e.low](const Vec3& p) { return rays->crossings(p) == wanted; });
    return on_place(context, [rays, odd = e.side > 0](const Vec3& p) { return (rays->crossings(p) % 2 == 1) == odd; });
}

RangeTest by_distance(const RangeElement& e, RangeContext& context) {
    const auto surfaces = std::make_shared<const SurfaceDistance>(polygons_of(e, context));
    return on_place(context, [surfaces, most = e.distance + context.tolerance](const Vec3& p) {
        return surfaces->within(p, most);
    });
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
    RangeEntry{Kind::x, along_axis<0>},
    RangeEntry{Kind::y, along_axis<1>},
    RangeEntry{Kind::z, along_axis<2>},
    RangeEntry{Kind::box, in_box},
    RangeEntry{Kind::plane, by_plane},
    RangeEntry{Kind::sphere, in_sphere},
    RangeEntry{Kind::cylinder, in_cylinder},
    RangeEntry{Kind::polygon, in_polygon},
    RangeEntry{Kind::ellipse, in_ellipse},
    RangeEntry{Kind::ground, by_ground},
    RangeEntry{Kind::geometry_space, by_crossings},
    RangeEntry{Kind::geometry_distance, by_distance},
};
constexpr std::array face_tests{RangeEntry{Kind::orientation, by_orientation}};

} // namespace

std::span<const RangeEntry> tests_of_places() { return place_tests; }
std::span<const RangeEntry> tests_of_faces() { return face_tests; }

} // namespace kaya
