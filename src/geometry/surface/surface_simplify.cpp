#include "geometry/surface/surface_simplify.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/surface/surface_checks.hpp"
#include "geometry/surface/winding.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace kaya {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Kept = Mesh::Property_map<Mesh::Edge_index, bool>;

/// The least that closes a body.
constexpr std::size_t tetrahedron = 4;

/// Checks for a request to stop before each collapse.
struct StopVisitor {
    StopPoints* stops;
    void OnStarted(Mesh&) const {}
    void OnFinished(Mesh&) const {}
    template <class Profile> void OnStopConditionReached(const Profile&) const {}
    template <class Profile, class Cost> void OnCollected(const Profile&, const Cost&) const { stops->pass(); }
    template <class Profile, class Cost> void OnSelected(const Profile&, const Cost&, std::size_t, std::size_t) const {
        stops->pass();
    }
    template <class Profile, class Place> void OnCollapsing(const Profile&, const Place&) const {}
    template <class Profile, class Vertex> void OnCollapsed(const Profile&, Vertex) const {}
    template <class Profile> void OnNonCollapsable(const Profile&) const {}
};

void collapse_edges(Mesh& mesh, const Kept& kept, std::size_t faces) {
    namespace simplification = CGAL::Surface_mesh_simplification;
    StopPoints stops;
    const std::size_t edges = 3 * faces / 2; // of a closed surface of triangles
    simplification::edge_collapse(
        mesh, simplification::Count_stop_predicate<Mesh>(edges + 1),
        CGAL::parameters::edge_is_constrained_map(kept)
            .get_cost(simplification::LindstromTurk_cost<Mesh>())
            .get_placement(
                simplification::Constrained_placement<simplification::LindstromTurk_placement<Mesh>, Kept>(kept))
            .filter(simplification::Bounded_normal_change_filter<>())
            .visitor(StopVisitor{&stops}));
    mesh.collect_garbage();
}

/// Boxes around triangles that cross others.
std::vector<CGAL::Bbox_3> crossings_of(const Mesh& mesh) {
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
    std::vector<CGAL::Bbox_3> boxes;
    for (const auto& [a, b] : pairs)
        for (const auto face : {a, b}) {
            CGAL::Bbox_3 box;
            for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) box += mesh.point(v).bbox();
            boxes.push_back(box);
        }
    return boxes;
}

/// Fewer triangles without crossings: where triangles would cross, the edges that were there before are kept. Nothing if that does not help.
std::optional<Mesh> reduced(const Mesh& before, std::size_t faces) {
    constexpr int most_trials = 8;
    Mesh start = before;
    Kept kept = start.add_property_map<Mesh::Edge_index, bool>("e:kept", false).first;
    for (int trial = 0; trial < most_trials; ++trial) {
        Mesh after = start;
        collapse_edges(after, after.property_map<Mesh::Edge_index, bool>("e:kept").first, faces);
        stop_point();
        const auto crossings = crossings_of(after);
        if (crossings.empty()) {
            Kept of_after = after.property_map<Mesh::Edge_index, bool>("e:kept").first;
            after.remove_property_map(of_after);
            return after;
        }
        for (const auto edge : start.edges()) {
            const CGAL::Bbox_3 box =
                start.point(start.vertex(edge, 0)).bbox() + start.point(start.vertex(edge, 1)).bbox();
            if (std::ranges::any_of(crossings, [&](const CGAL::Bbox_3& at) { return CGAL::do_overlap(at, box); }))
                kept[edge] = true;
        }
    }
    return std::nullopt;
}

/// Distances from points to the triangles of a mesh.
class Distances {
public:
    explicit Distances(const Mesh& mesh) : tree_(mesh.faces_begin(), mesh.faces_end(), mesh) {
        tree_.accelerate_distance_queries();
    }
    double squared(const Kernel::Point_3& point) {
        stops_.pass();
        return tree_.squared_distance(point);
    }

private:
    using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
    StopPoints stops_;
};

/// The greatest distance between two surfaces; the first that is above `most` where there is one.
class Deviation {
public:
    explicit Deviation(const Mesh& given) : given_(given), to_given_(given) {}

    double of(const Mesh& mesh, double most) {
        constexpr int parts = 4; // of each side: fifteen points of a triangle
        const double enough = most * most;
        double greatest = 0;
        for (const auto face : mesh.faces()) {
            std::array<Kernel::Point_3, 3> p;
            std::size_t k = 0;
            for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) p[k++] = mesh.point(v);
            const auto along = (p[1] - p[0]) / parts, across = (p[2] - p[0]) / parts;
            for (int i = 0; i <= parts; ++i)
                for (int j = 0; i + j <= parts; ++j)
                    greatest = std::max(greatest, to_given_.squared(p[0] + i * along + j * across));
            if (greatest > enough) return std::sqrt(greatest);
        }
        Distances to_mesh(mesh);
        for (const auto v : given_.vertices()) {
            greatest = std::max(greatest, to_mesh.squared(given_.point(v)));
            if (greatest > enough) break;
        }
        return std::sqrt(greatest);
    }

private:
    const Mesh& given_;
    Distances to_given_;
};

struct Reduced {
    Mesh mesh;
    double deviation = 0;
};

/// Halves the number of triangles as long as the limits allow, then searches between the last two numbers.
Reduced reduce(const Mesh& given, std::size_t least, double most) {
    constexpr double close = 0.02; // of the number of triangles
    const bool limited = most < std::numeric_limits<double>::infinity();
    Deviation deviation(given);
    Reduced best{given, 0};
    const auto advance = [&](std::size_t faces) {
        std::optional<Mesh> trial = reduced(best.mesh, faces);
        if (!trial || trial->number_of_faces() >= best.mesh.number_of_faces()) return false;
        const double moved = limited ? deviation.of(*trial, most) : 0;
        if (moved > most) return false;
        best = {std::move(*trial), moved};
        return true;
    };
    std::size_t refused = least;
    for (;;) {
        const std::size_t faces = best.mesh.number_of_faces();
        if (faces <= least) break;
        refused = std::max(least, faces / 2);
        if (!advance(refused)) break;
    }
    while (limited && best.mesh.number_of_faces() > refused) {
        const std::size_t faces = best.mesh.number_of_faces(), middle = (faces + refused) / 2;
        if (static_cast<double>(faces - refused) <= 2 + close * static_cast<double>(faces)) break;
        if (!advance(middle)) refused = middle;
    }
    if (!limited) best.deviation = deviation.of(best.mesh, most);
    return best;
}

/// To lengths near 1 around the origin, for the digits, and back; the unit is a power of two, which rounds no digits.
struct Frame {
    Vec3 centre;
    double unit;

    explicit Frame(const std::vector<Vec3>& vertices) {
        const auto [low, high] = box_around(vertices);
        centre = 0.5 * low + 0.5 * high;
        const double size = (high - low).maxCoeff();
        if (!(std::isnormal(size) && (high - low).allFinite()))
            throw Diagnostic(fmt::format("the surface has the size {:g} and cannot be simplified", size),
                             "check the coordinates of the file");
        unit = std::exp2(std::ilogb(size));
    }
    Kernel::Point_3 in(const Vec3& v) const {
        const Vec3 at = (v - centre) / unit;
        return {at.x(), at.y(), at.z()};
    }
    Vec3 out(const Kernel::Point_3& p) const { return centre + unit * Vec3(p.x(), p.y(), p.z()); }
};

Mesh mesh_of(const Surface& surface, const Frame& frame) {
    Mesh mesh;
    std::vector<Mesh::Vertex_index> vertices;
    for (const Vec3& v : surface.vertices) vertices.push_back(mesh.add_vertex(frame.in(v)));
    StopPoints stops;
    for (const auto& face : surface.faces) {
        stops.pass();
        for (const auto& t : triangles_of(surface.vertices, face))
            if (mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) == Mesh::null_face())
                throw Diagnostic(fmt::format("{} touches the rest of the surface in more than its edges", face.name),
                                 "two parts of a block may not meet in a corner or an edge alone");
    }
    return mesh;
}

Surface surface_of(const Mesh& mesh, const Frame& frame) {
    Surface surface;
    for (const auto v : mesh.vertices()) surface.vertices.push_back(frame.out(mesh.point(v)));
    for (const auto face : mesh.faces()) {
        Surface::Face loop{{}, 0, fmt::format("simplified face {}", surface.faces.size() + 1)};
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(face)))
            loop.vertices.push_back(static_cast<int>(v.idx()));
        surface.faces.push_back(std::move(loop));
    }
    return surface;
}

} // namespace

Surface simplified(Surface surface, const Simplification& wanted, SimplifyCounts& counts) {
    check_faces(surface);
    turn_alike(surface);
    turn_outward(surface);
    const Frame frame(surface.vertices);
    const Mesh given = mesh_of(surface, frame);
    const std::size_t least = std::max(tetrahedron, static_cast<std::size_t>(std::max<std::int64_t>(0, wanted.faces)));
    if (given.number_of_faces() <= least) return surface;
    const double most = wanted.deviation > 0 ? wanted.deviation / frame.unit : std::numeric_limits<double>::infinity();
    const Reduced found = reduce(given, least, most);
    if (found.mesh.number_of_faces() == given.number_of_faces()) {
        if (const auto crossings = crossing_faces(surface); !crossings.empty())
            throw Diagnostic(fmt::format("the surface crosses itself: {} cuts through {}", crossings.front().first,
                                         crossings.front().second));
        return surface;
    }
    Surface result = surface_of(found.mesh, frame);
    ++counts.bodies;
    counts.before += given.number_of_faces();
    counts.after += found.mesh.number_of_faces();
    constexpr double rounding = 1e-12;
    if (found.deviation > rounding) counts.deviation = std::max(counts.deviation, frame.unit * found.deviation);
    counts.volume_before += volume_of(triangles_of(surface));
    counts.volume_after += volume_of(triangles_of(result));
    return result;
}

} // namespace kaya
