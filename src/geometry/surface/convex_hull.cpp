#include "geometry/surface/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <fmt/format.h>

namespace kaya {

Surface convex_hull(const std::vector<Vec3>& points) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Point = Kernel::Point_3;
    std::vector<Point> given;
    given.reserve(points.size());
    for (const Vec3& p : points) given.emplace_back(p.x(), p.y(), p.z());
    CGAL::Surface_mesh<Point> mesh;
    Surface hull;
    if (given.size() < 4) return hull;
    CGAL::convex_hull_3(given.begin(), given.end(), mesh);
    for (const auto v : mesh.vertices()) {
        const Point& p = mesh.point(v);
        hull.vertices.emplace_back(p.x(), p.y(), p.z());
    }
    if (hull.vertices.size() < 4) return hull;
    for (const auto f : mesh.faces()) {
        Surface::Face face{{}, 0, fmt::format("face {}", hull.faces.size() + 1)};
        for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
            face.vertices.push_back(static_cast<int>(v.idx()));
        hull.faces.push_back(std::move(face));
    }
    return hull;
}

} // namespace kaya
