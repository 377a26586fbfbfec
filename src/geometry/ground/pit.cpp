#include "geometry/ground/pit.hpp"

#include "base/diagnostic.hpp"
#include "base/plane_cross.hpp"
#include "geometry/ground/pit_profile.hpp"
#include "geometry/ground/pit_strips.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/create_offset_polygons_2.h>
#include <CGAL/create_straight_skeleton_2.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;

/// The outline as a polygon about its first corner, anticlockwise. Throws Diagnostic.
Polygon polygon_of(const std::vector<Vec3>& outline) {
    if (outline.size() < 3)
        throw Diagnostic("the outline of a pit needs three corners or more",
                         "give them in order, one to a line: x y z");
    double low = INFINITY, high = -INFINITY, size = 0;
    for (const Vec3& p : outline) {
        low = std::min(low, p.z()), high = std::max(high, p.z());
        size = std::max(size, (p - outline.front()).head<2>().norm());
    }
    if (high - low > 1e-6 * size)
        throw Diagnostic(
            fmt::format("the outline of a pit must be level, and its heights are {:.6g} to {:.6g}", low, high),
            "give it the height of the crest or the toe");
    Polygon polygon;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3 p = outline[i] - outline.front(), &next = outline[(i + 1) % outline.size()];
        if ((next - outline[i]).head<2>().norm() < 1e-9 * size)
            throw Diagnostic(
                fmt::format("corners {} and {} of the outline are the same", i + 1, (i + 1) % outline.size() + 1),
                "leave one of them out");
        polygon.push_back({p.x(), p.y()});
    }
    if (!polygon.is_simple())
        throw Diagnostic("the outline of the pit crosses or touches itself", "give its corners in order around it");
    if (polygon.is_clockwise_oriented()) polygon.reverse_orientation();
    return polygon;
}

/// The polygon so far outside of another. Throws Diagnostic where an edge vanishes or the outside meets itself.
Polygon outside_of(const Polygon& polygon, double distance) {
    const auto offsets = CGAL::create_exterior_skeleton_and_offset_polygons_2(distance, polygon);
    // One of them is the outer frame.
    std::vector<Polygon> found;
    for (const auto& offset : offsets) found.push_back(*offset);
    std::ranges::sort(found, [](const Polygon& a, const Polygon& b) {
        return std::abs(CGAL::to_double(a.area())) > std::abs(CGAL::to_double(b.area()));
    });
    if (found.size() != 2 || found.back().size() != polygon.size())
        throw Diagnostic(
            fmt::format("on the way from the toe to the crest, {:.6g} outward, an edge of the outline vanishes",
                        distance),
            "remove corners that lie close together where the outline bends inward, or give the crest");
    Polygon outer = found.back();
    if (outer.is_clockwise_oriented()) outer.reverse_orientation();
    return outer;
}

SectionVector vector_of(const Kernel::Point_2& p) { return {p.x(), p.y()}; }

/// The region inside each edge.
std::vector<PitStrip> strips_of(const Polygon& crest, const PitProfile& profile, double beyond) {
    const auto skeleton = CGAL::create_interior_straight_skeleton_2(crest);
    if (!skeleton) throw Diagnostic("the outline of the pit has no inside that can be divided", "look at its corners");
    double deepest = 0;
    for (auto v = skeleton->vertices_begin(); v != skeleton->vertices_end(); ++v)
        deepest = std::max(deepest, CGAL::to_double(v->time()));
    if (!(deepest > (profile.width() + beyond) * (1 + 1e-6)))
        throw Diagnostic(
            fmt::format(
                "the walls meet above the floor: they need {:.6g} from the crest{}, and the pit has {:.6g} to its middle",
                profile.width() + beyond, beyond > 0 ? " with the ramp" : "", deepest),
            "give fewer benches, steeper faces or a larger outline");
    std::vector<PitStrip> strips(crest.size());
    for (auto f = skeleton->faces_begin(); f != skeleton->faces_end(); ++f) {
        const auto contour = f->halfedge()->defining_contour_edge();
        const SectionVector from = vector_of(contour->opposite()->vertex()->point()),
                            to = vector_of(contour->vertex()->point());
        std::size_t edge = 0;
        double nearest = INFINITY;
        for (std::size_t e = 0; e < crest.size(); ++e)
            if (const double off = (vector_of(crest[e]) - from).norm(); off < nearest) nearest = off, edge = e;
        PitStrip& strip = strips[edge];
        strip.from = from, strip.along = (to - from).normalized(), strip.edge.length = (to - from).norm();
        strip.edge.until = INFINITY;
        auto h = f->halfedge();
        do {
            strip.corners.push_back(vector_of(h->vertex()->point()));
            if (const double time = CGAL::to_double(h->vertex()->time()); time > 0)
                strip.edge.until = std::min(strip.edge.until, time);
            h = h->next();
        } while (h != f->halfedge());
    }
    for (std::size_t e = 0; e < strips.size(); ++e) {
        PitStrip &before = strips[(e + strips.size() - 1) % strips.size()], &after = strips[e];
        // Cotangent of half the interior angle: (1 + cos turn)/sin turn of the outline, seen from inside.
        const double shrinks =
            std::tan(0.5 * std::atan2(cross(before.along, after.along), before.along.dot(after.along)));
        before.edge.shrinks[1] = after.edge.shrinks[0] = shrinks;
    }
    return strips;
}

/// The place of the crest that is nearest to a point: its edge, and how far along.
std::pair<std::size_t, double> nearest_place(const std::vector<PitStrip>& strips, const SectionVector& point) {
    std::pair<std::size_t, double> best{0, 0};
    double nearest = INFINITY;
    for (std::size_t e = 0; e < strips.size(); ++e) {
        const double s = std::clamp((point - strips[e].from).dot(strips[e].along), 0.0, strips[e].edge.length);
        const double off = (strips[e].from + s * strips[e].along - point).norm();
        if (off < nearest) nearest = off, best = {e, s};
    }
    return best;
}

} // namespace

Ground pit_surface(const std::vector<Vec3>& outline, const PitDesign& design) {
    // A clockwise ramp is an anticlockwise one in a mirror.
    const double mirror = design.ramp && design.ramp->clockwise ? -1 : 1;
    std::vector<Vec3> seen = outline;
    for (Vec3& p : seen) p.x() *= mirror;
    const PitProfile profile(design);
    Polygon crest = polygon_of(seen);
    if (design.toe) crest = outside_of(crest, profile.width());
    std::vector<PitStrip> strips = strips_of(crest, profile, design.ramp ? design.ramp->width : 0);
    const Vec3 origin(seen.front().x(), seen.front().y(), seen.front().z() + (design.toe ? profile.depth() : 0));
    if (design.ramp) {
        const SectionVector from(mirror * design.ramp->from[0] - origin.x(), design.ramp->from[1] - origin.y());
        const auto [edge, at] = nearest_place(strips, from);
        std::vector<CrestEdge> edges;
        for (const PitStrip& strip : strips) edges.push_back(strip.edge);
        auto parts = ramp_parts(profile, *design.ramp, edges, edge, at);
        for (std::size_t e = 0; e < strips.size(); ++e) strips[e].ramp = std::move(parts[e]);
    }
    PitMesh mesh = mesh_of(strips, profile);
    for (Vec3& corner : mesh.corners) {
        corner += origin;
        corner.x() *= mirror;
    }
    return {std::move(mesh.corners), std::move(mesh.triangles)};
}

} // namespace kaya
