#include "base/diagnostic.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

namespace kaya {

std::vector<std::pair<std::string, std::string>> crossing_faces(const Surface& surface) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
    Mesh mesh;
    std::vector<Mesh::Vertex_index> vertices;
    for (const Vec3& v : surface.vertices) vertices.push_back(mesh.add_vertex({v.x(), v.y(), v.z()}));
    std::vector<int> face_of;
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
        for (const auto& t : triangles_of(surface.vertices, surface.faces[f])) {
            if (mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) == Mesh::null_face())
                throw Diagnostic(
                    fmt::format("{} touches the rest of the surface in more than its edges", surface.faces[f].name),
                    "two parts of a block may not meet in a corner or an edge alone");
            face_of.push_back(static_cast<int>(f));
        }
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> crossings;
    CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(crossings));
    std::vector<std::pair<std::string, std::string>> names;
    for (const auto& [a, b] : crossings)
        if (face_of[a] != face_of[b])
            names.emplace_back(surface.faces[face_of[a]].name, surface.faces[face_of[b]].name);
    return names;
}

} // namespace kaya
