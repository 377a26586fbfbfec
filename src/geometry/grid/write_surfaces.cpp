// The surfaces of blocks in the formats of other programs. A block is an object of the file; its group is the name of the object.
#include "base/json_text.hpp"
#include "geometry/grid/file_formats.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <iterator>

namespace kaya {
namespace {

/// Calls write(block, its surface, faces outward).
void each_surface(const Grid3d& grid, auto write) {
    for (const Grid3d::Block& block : grid.blocks) write(block, surface_of(grid, block));
}

} // namespace

std::string write_stl(const Grid3d& grid) {
    std::string text;
    const auto out = std::back_inserter(text);
    each_surface(grid, [&](const Grid3d::Block& block, const Surface& surface) {
        const std::string name = block.group.empty() ? "" : " " + quoted_name(block.group);
        fmt::format_to(out, "solid{}\n", name);
        for (const Surface::Face& face : surface.faces)
            for (const auto& triangle : triangles_of(surface.vertices, face)) {
                const Vec3 &a = surface.vertices[triangle[0]], &b = surface.vertices[triangle[1]],
                           &c = surface.vertices[triangle[2]];
                const Vec3 normal = (b - a).cross(c - a).normalized();
                fmt::format_to(out, "facet normal {} {} {}\nouter loop\n", normal.x(), normal.y(), normal.z());
                for (const Vec3& v : {a, b, c}) fmt::format_to(out, "vertex {} {} {}\n", v.x(), v.y(), v.z());
                text += "endloop\nendfacet\n";
            }
        fmt::format_to(out, "endsolid{}\n", name);
    });
    return text;
}

std::string write_obj(const Grid3d& grid) {
    std::string text = "# written by kaya\n";
    const auto out = std::back_inserter(text);
    int first = 1;
    each_surface(grid, [&](const Grid3d::Block& block, const Surface& surface) {
        fmt::format_to(out, "g{}\n", block.group.empty() ? "" : " " + quoted_name(block.group));
        for (const Vec3& v : surface.vertices) fmt::format_to(out, "v {} {} {}\n", v.x(), v.y(), v.z());
        for (const Surface::Face& face : surface.faces) {
            text += 'f';
            for (const int vertex : face.vertices) fmt::format_to(out, " {}", first + vertex);
            text += '\n';
        }
        first += static_cast<int>(surface.vertices.size());
    });
    return text;
}

std::string write_ply(const Grid3d& grid) {
    std::string vertices, faces, groups;
    int vertex_count = 0, face_count = 0, block_count = 0;
    each_surface(grid, [&](const Grid3d::Block& block, const Surface& surface) {
        ++block_count;
        if (!block.group.empty())
            fmt::format_to(std::back_inserter(groups), "comment group {} {}\n", block_count, quoted_name(block.group));
        for (const Vec3& v : surface.vertices)
            fmt::format_to(std::back_inserter(vertices), "{} {} {}\n", v.x(), v.y(), v.z());
        for (const Surface::Face& face : surface.faces) {
            fmt::format_to(std::back_inserter(faces), "{}", face.vertices.size());
            for (const int vertex : face.vertices)
                fmt::format_to(std::back_inserter(faces), " {}", vertex_count + vertex);
            fmt::format_to(std::back_inserter(faces), " {}\n", block_count);
        }
        vertex_count += static_cast<int>(surface.vertices.size());
        face_count += static_cast<int>(surface.faces.size());
    });
    return fmt::format("ply\nformat ascii 1.0\ncomment written by kaya\n{}element vertex {}\nproperty double x\n"
                       "property double y\nproperty double z\nelement face {}\nproperty list int int vertex_indices\n"
                       "property int block\nend_header\n{}{}",
                       groups, vertex_count, face_count, vertices, faces);
}

/// A list of meshes as COMPAS 2 reads and writes them.
std::string write_compas(const Grid3d& grid) {
    std::string text = "[";
    const auto out = std::back_inserter(text);
    each_surface(grid, [&](const Grid3d::Block& block, const Surface& surface) {
        text += text.size() > 1 ? ",\n" : "\n";
        fmt::format_to(
            out, "{{\"dtype\": \"compas.datastructures/Mesh\",{} \"data\": {{\"attributes\": {{}},\n\"vertex\": {{",
            block.group.empty() ? "" : fmt::format(" \"name\": {},", json_text(block.group)));
        for (std::size_t k = 0; k < surface.vertices.size(); ++k) {
            const Vec3& v = surface.vertices[k];
            fmt::format_to(out, "{}\"{}\": {{\"x\": {}, \"y\": {}, \"z\": {}}}", k > 0 ? ", " : "", k, v.x(), v.y(),
                           v.z());
        }
        text += "},\n\"face\": {";
        for (std::size_t k = 0; k < surface.faces.size(); ++k)
            fmt::format_to(out, "{}\"{}\": [{}]", k > 0 ? ", " : "", k, fmt::join(surface.faces[k].vertices, ", "));
        fmt::format_to(out, "}},\n\"facedata\": {{}}, \"edgedata\": {{}}, \"max_vertex\": {}, \"max_face\": {}}}}}",
                       surface.vertices.size() - 1, surface.faces.size() - 1);
    });
    return text + "\n]\n";
}

} // namespace kaya
