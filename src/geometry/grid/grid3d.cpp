#include "geometry/grid/grid3d.hpp"

#include "base/diagnostic.hpp"
#include "geometry/grid/joint_sets.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace kaya {
namespace {

using Triangle = std::array<int, 3>;

/// The triangles of the zones that no other zone of the block has, outward.
std::vector<Triangle> outer_triangles(const Grid3d& grid, const Grid3d::Block& block) {
    static constexpr std::array<Triangle, 4> corners{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    std::map<Triangle, Triangle> open;
    for (const int zone : block.zones) {
        const auto& t = grid.zones.at(zone);
        const Vec3& a = grid.gridpoints.at(t[0]);
        const double volume =
            (grid.gridpoints.at(t[1]) - a).cross(grid.gridpoints.at(t[2]) - a).dot(grid.gridpoints.at(t[3]) - a);
        for (const auto& [i, j, k] : corners) {
            Triangle triangle{t[i], t[j], t[k]};
            if (volume < 0) std::swap(triangle[1], triangle[2]);
            Triangle key = triangle;
            std::sort(key.begin(), key.end());
            const auto [place, fresh] = open.emplace(key, triangle);
            if (!fresh) open.erase(place);
        }
    }
    std::vector<Triangle> result;
    for (const auto& [key, triangle] : open) result.push_back(triangle);
    return result;
}

/// Joint set number for each pair of blocks, lower number first.
std::map<std::array<int, 2>, int> sets_between(const Grid3d& grid) {
    std::map<std::array<int, 2>, int> result;
    for (const auto& set : grid.joint_sets)
        for (const auto& [a, b] : set.blocks) result[{std::min(a, b), std::max(a, b)}] = set.number;
    return result;
}

/// Joint sets of the faces of a block, through the other block that uses the same face.
std::map<int, int> joint_sets_of_faces(const Grid3d& grid, const Grid3d::Block& block) {
    std::map<int, int> result;
    if (grid.joint_sets.empty()) return result;
    const auto sets = sets_between(grid);
    const std::set<int> own(block.faces.begin(), block.faces.end());
    for (const auto& other : grid.blocks) {
        const auto set = sets.find({std::min(block.number, other.number), std::max(block.number, other.number)});
        if (set == sets.end()) continue;
        for (const int face : other.faces)
            if (own.contains(face)) result[face] = set->second;
    }
    return result;
}

/// The face of the polyhedron whose plane the triangle lies in best.
int face_of(const Polyhedron& polyhedron, const std::array<Vec3, 3>& triangle) {
    const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
    int best = 0;
    double least = 1e300;
    const double size = size_of(polyhedron.vertices);
    for (std::size_t f = 0; f < polyhedron.faces.size(); ++f) {
        const Vec3 other = face_normal(polyhedron, polyhedron.faces[f]);
        const Vec3& origin = polyhedron.vertices[polyhedron.faces[f].vertices[0]];
        double off = (1 - normal.dot(other)) * size;
        for (const Vec3& corner : triangle) off += std::abs(other.dot(corner - origin));
        if (off >= least) continue;
        least = off;
        best = static_cast<int>(f);
    }
    return best;
}

} // namespace

Surface surface_of(const Grid3d& grid, const Grid3d::Block& block) {
    Surface surface;
    std::map<int, int> number;
    const auto vertex = [&](int gridpoint) {
        const auto [place, fresh] = number.emplace(gridpoint, static_cast<int>(surface.vertices.size()));
        if (fresh) surface.vertices.push_back(grid.gridpoints.at(gridpoint));
        return place->second;
    };
    const auto sets = joint_sets_of_faces(grid, block);
    for (const int face : block.faces) {
        Surface::Face result;
        result.name = fmt::format("face {} of block {}", face, block.number);
        for (const int gridpoint : grid.faces.at(face)) result.vertices.push_back(vertex(gridpoint));
        if (const auto set = sets.find(face); set != sets.end()) result.joint_set = set->second;
        surface.faces.push_back(std::move(result));
    }
    for (const auto& [a, b, c] : outer_triangles(grid, block))
        surface.faces.push_back(
            {{vertex(a), vertex(b), vertex(c)}, 0, fmt::format("a zone face of block {}", block.number)});
    return surface;
}

TetMesh zones_of(const Grid3d& grid, const Grid3d::Block& block, const Polyhedron& polyhedron) {
    TetMesh mesh;
    std::map<int, int> number;
    for (const int zone : block.zones) {
        std::array<int, 4> t{};
        for (int i = 0; i < 4; ++i) {
            const int gridpoint = grid.zones.at(zone)[i];
            const auto [place, fresh] = number.emplace(gridpoint, static_cast<int>(mesh.points.size()));
            if (fresh) mesh.points.push_back(grid.gridpoints.at(gridpoint));
            t[i] = place->second;
        }
        const Vec3& a = mesh.points[t[0]];
        const double volume = (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a).dot(mesh.points[t[3]] - a);
        const double size = (mesh.points[t[1]] - a).norm() + (mesh.points[t[2]] - a).norm();
        if (std::abs(volume) <= 1e-12 * size * size * size)
            throw Diagnostic(fmt::format("zone {} of block {} has no volume", zone, block.number));
        if (volume < 0) std::swap(t[2], t[3]);
        mesh.tetrahedra.push_back(t);
    }
    for (const auto& [a, b, c] : outer_triangles(grid, block)) {
        const std::array<int, 3> points{number.at(a), number.at(b), number.at(c)};
        mesh.boundary.push_back(
            {points, face_of(polyhedron, {mesh.points[points[0]], mesh.points[points[1]], mesh.points[points[2]]})});
    }
    return mesh;
}

Grid3d grid_of(const std::vector<GridShape>& blocks, Corners corners) {
    Grid3d grid;
    std::map<std::array<double, 3>, int> gridpoints;
    std::map<std::vector<int>, int> faces; ///< numbers by their gridpoints
    const auto gridpoint = [&](const Vec3& place) {
        const Vec3 p = place + Vec3::Zero(); // adding zero makes one number of 0 and -0
        const auto [found, fresh] = gridpoints.emplace(std::array{p.x(), p.y(), p.z()}, 0);
        if (fresh) {
            found->second = static_cast<int>(grid.gridpoints.size()) + 1;
            grid.gridpoints[found->second] = p;
        }
        return found->second;
    };
    for (const GridShape& block : blocks) {
        if (corners == Corners::own) {
            gridpoints.clear();
            faces.clear();
        }
        Grid3d::Block result{block.number, block.region, {}, {}, block.group, block.material};
        if (block.zones != nullptr) {
            for (const auto& t : block.zones->tetrahedra) {
                const int next = static_cast<int>(grid.zones.size()) + 1;
                auto& zone = grid.zones[next];
                for (std::size_t k = 0; k < 4; ++k)
                    zone[k] = gridpoint(block.zones->points[static_cast<std::size_t>(t[k])]);
                result.zones.push_back(next);
            }
            grid.blocks.push_back(std::move(result));
            continue;
        }
        for (const auto& face : block.shape->faces) {
            std::vector<int> loop;
            for (const int v : face.vertices) loop.push_back(gridpoint(block.shape->vertices[v]));
            std::vector<int> key = loop;
            std::sort(key.begin(), key.end());
            const auto [place, fresh] = faces.emplace(std::move(key), static_cast<int>(grid.faces.size()) + 1);
            if (fresh) grid.faces[place->second] = loop;
            result.faces.push_back(place->second);
        }
        grid.blocks.push_back(std::move(result));
    }
    if (corners == Corners::shared) grid.joint_sets = joint_sets_between(blocks);
    return grid;
}

} // namespace kaya
