// Zones and blocks in the formats of programs with meshes.
#include "geometry/grid/file_formats.hpp"
#include "geometry/grid/vtu_grid.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace kaya {
namespace {

/// Rigid blocks as zones from a new gridpoint in their middle to the triangles of their faces.
Grid3d with_zones(Grid3d grid) {
    for (Grid3d::Block& block : grid.blocks) {
        if (!block.zones.empty()) continue;
        std::vector<int> numbers;
        for (const int face : block.faces)
            for (const int gridpoint : grid.faces.at(face))
                if (std::ranges::find(numbers, gridpoint) == numbers.end()) numbers.push_back(gridpoint);
        Surface surface;
        Vec3 middle = Vec3::Zero();
        for (const int number : numbers) {
            surface.vertices.push_back(grid.gridpoints.at(number));
            middle += (surface.vertices.back() - surface.vertices.front());
        }
        middle = surface.vertices.front() + middle / static_cast<double>(numbers.size());
        const int apex = grid.gridpoints.rbegin()->first + 1;
        grid.gridpoints[apex] = middle;
        for (const int face : block.faces) {
            Surface::Face loop;
            for (const int gridpoint : grid.faces.at(face))
                loop.vertices.push_back(static_cast<int>(std::ranges::find(numbers, gridpoint) - numbers.begin()));
            for (const auto& t : triangles_of(surface.vertices, loop)) {
                const int next = static_cast<int>(grid.zones.size()) + 1;
                // Faces are outward: seen from the middle they are clockwise.
                grid.zones[next] = {numbers[static_cast<std::size_t>(t[0])], numbers[static_cast<std::size_t>(t[2])],
                                    numbers[static_cast<std::size_t>(t[1])], apex};
                block.zones.push_back(next);
            }
        }
        block.faces.clear();
    }
    return grid;
}

/// The groups of blocks in their order, each once.
std::vector<std::string> groups_of(const Grid3d& grid) {
    std::vector<std::string> groups;
    for (const Grid3d::Block& block : grid.blocks)
        if (!block.group.empty() && std::ranges::find(groups, block.group) == groups.end())
            groups.push_back(block.group);
    return groups;
}

} // namespace

std::string write_f3grid(const Grid3d& given) {
    const Grid3d grid = with_zones(given);
    std::string text = "* written by kaya\n*GRIDPOINTS\n";
    const auto out = std::back_inserter(text);
    for (const auto& [number, p] : grid.gridpoints) fmt::format_to(out, "G {} {} {} {}\n", number, p.x(), p.y(), p.z());
    text += "*ZONES\n";
    for (const auto& [number, t] : grid.zones) fmt::format_to(out, "Z T4 {} {}\n", number, fmt::join(t, " "));
    text += "*ZONE GROUPS\n";
    for (const std::string& group : groups_of(grid)) {
        fmt::format_to(out, "ZGROUP {} SLOT Default\n", quoted_name(group));
        constexpr std::size_t most_in_line = 20;
        for (const Grid3d::Block& block : grid.blocks) {
            if (block.group != group) continue;
            for (std::size_t k = 0; k < block.zones.size(); ++k)
                fmt::format_to(out, "{}{}", block.zones[k],
                               k + 1 == block.zones.size() || k % most_in_line + 1 == most_in_line ? '\n' : ' ');
        }
    }
    return text;
}

/// Version 2.2, which more programs read than 4.1. A block is a volume of the geometry; a group is a physical group.
std::string write_msh(const Grid3d& given) {
    const Grid3d grid = with_zones(given);
    const std::vector<std::string> groups = groups_of(grid);
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "$PhysicalNames\n{}\n", groups.size());
    for (std::size_t k = 0; k < groups.size(); ++k) fmt::format_to(out, "3 {} {}\n", k + 1, quoted_name(groups[k]));
    fmt::format_to(out, "$EndPhysicalNames\n$Nodes\n{}\n", grid.gridpoints.size());
    for (const auto& [number, p] : grid.gridpoints) fmt::format_to(out, "{} {} {} {}\n", number, p.x(), p.y(), p.z());
    fmt::format_to(out, "$EndNodes\n$Elements\n{}\n", grid.zones.size());
    for (const Grid3d::Block& block : grid.blocks) {
        const auto group = std::ranges::find(groups, block.group);
        const auto physical = group == groups.end() ? 0 : group - groups.begin() + 1;
        for (const int zone : block.zones)
            fmt::format_to(out, "{} 4 2 {} {} {}\n", zone, physical, block.number, fmt::join(grid.zones.at(zone), " "));
    }
    return text + "$EndElements\n";
}

/// Zones are tetrahedra, rigid blocks polyhedra. The data of a cell are those of its block.
std::string write_vtu(const Grid3d& grid) {
    VtuGrid file;
    std::map<int, Row> row_of;
    for (const auto& [number, p] : grid.gridpoints) {
        row_of.emplace_hint(row_of.end(), number, static_cast<Row>(file.points.size()));
        file.points.push_back(p);
    }
    const std::vector<std::string> groups = groups_of(grid);
    std::vector<std::int32_t> numbers, regions, materials, group_numbers;
    for (const Grid3d::Block& block : grid.blocks) {
        for (const int zone : block.zones) {
            std::array<Row, 4> corners{};
            std::ranges::transform(grid.zones.at(zone), corners.begin(), [&](int g) { return row_of.at(g); });
            file.add_cell(VtuCell::tetrahedron, corners);
        }
        if (block.zones.empty()) {
            std::vector<std::vector<Row>> faces;
            for (const int face : block.faces) {
                faces.emplace_back();
                for (const int gridpoint : grid.faces.at(face)) faces.back().push_back(row_of.at(gridpoint));
            }
            file.add_polyhedron(faces);
        }
        const std::size_t cells = std::max<std::size_t>(block.zones.size(), 1);
        numbers.insert(numbers.end(), cells, block.number);
        regions.insert(regions.end(), cells, block.region);
        materials.insert(materials.end(), cells, block.material);
        const auto group = std::ranges::find(groups, block.group);
        group_numbers.insert(group_numbers.end(), cells,
                             group == groups.end() ? -1 : static_cast<std::int32_t>(group - groups.begin()));
    }
    const auto add = [&](const char* name, const std::vector<std::int32_t>& values) {
        file.cell_data.push_back(vtu_array<std::int32_t>(name, values));
    };
    add("block", numbers);
    add("region", regions);
    add("material", materials);
    add("group", group_numbers);
    file.lists["group_names"] = groups;
    return file.bytes();
}

} // namespace kaya
