#include "geometry/grid/cell_zones.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace kaya {
namespace {

using Loop = std::vector<std::size_t>;

struct Shape {
    std::string_view name;
    std::size_t corners;
    std::vector<Loop> faces; ///< outward
};

const Shape& shape_of(CellKind kind) {
    static const std::array<Shape, 4> shapes{
        {{"tetrahedron", 4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
         {"pyramid", 5, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
         {"wedge", 6, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
         {"hexahedron", 8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}}};
    return shapes[static_cast<std::size_t>(kind)];
}

using Zone = std::array<int, 4>;

std::vector<Zone> zones_of(CellKind kind, std::span<const int> corner) {
    if (kind == CellKind::tetrahedron) return {{corner[0], corner[1], corner[2], corner[3]}};
    const int lowest = *std::ranges::min_element(corner);
    std::vector<Zone> zones;
    for (const Loop& face : shape_of(kind).faces) {
        std::vector<int> loop;
        for (const std::size_t k : face) loop.push_back(corner[k]);
        if (std::ranges::find(loop, lowest) != loop.end()) continue;
        std::rotate(loop.begin(), std::ranges::min_element(loop), loop.end());
        for (std::size_t k = 2; k < loop.size(); ++k) zones.push_back({lowest, loop[0], loop[k - 1], loop[k]});
    }
    return zones;
}

double six_volumes(const Grid3d& grid, const Zone& t) {
    const Vec3& a = grid.gridpoints.at(t[0]);
    return (grid.gridpoints.at(t[1]) - a).cross(grid.gridpoints.at(t[2]) - a).dot(grid.gridpoints.at(t[3]) - a);
}

} // namespace

std::size_t corners_of(CellKind kind) { return shape_of(kind).corners; }
std::string_view name_of(CellKind kind) { return shape_of(kind).name; }

void add_cell(Grid3d& grid, ZoneSet& set, const FailHere& fail, CellKind kind, long long number,
              std::span<const int> corners) {
    constexpr double flat = 1e-12; // of the cube of its size
    const std::vector<Zone> zones = zones_of(kind, corners);
    int right = 0, wrong = 0;
    for (const Zone& zone : zones) {
        double size = 0;
        for (const int node : zone)
            size = std::max(size, (grid.gridpoints.at(node) - grid.gridpoints.at(zone[0])).norm());
        const double volumes = six_volumes(grid, zone);
        if (!(std::abs(volumes) > flat * size * size * size))
            fail(fmt::format("{} {} has no volume", name_of(kind), number), "");
        (volumes > 0 ? right : wrong) += 1;
    }
    if (right > 0 && wrong > 0)
        fail(fmt::format("{} {} is turned inside out in part", name_of(kind), number),
             "its nodes stand in a wrong order, or it is warped too much");
    for (const Zone& zone : zones) {
        const int next = static_cast<int>(grid.zones.size()) + 1;
        grid.zones.emplace(next, zone);
        set.zones.push_back(next);
    }
}

void make_blocks(Grid3d& grid, const ZoneSet& set) {
    std::vector<std::size_t> leader(set.zones.size());
    std::iota(leader.begin(), leader.end(), std::size_t{0});
    const auto first_of = [&](std::size_t z) {
        while (leader[z] != z) z = leader[z] = leader[leader[z]];
        return z;
    };
    std::map<std::array<int, 3>, std::size_t> owner;
    for (std::size_t z = 0; z < set.zones.size(); ++z) {
        const auto& corner = grid.zones.at(set.zones[z]);
        for (std::size_t left_out = 0; left_out < 4; ++left_out) {
            std::array<int, 3> face{};
            for (std::size_t k = 0, i = 0; k < 4; ++k)
                if (k != left_out) face[i++] = corner[k];
            std::ranges::sort(face);
            const auto [other, is_new] = owner.emplace(face, z);
            if (is_new) continue;
            const std::size_t a = first_of(other->second), b = first_of(z);
            leader[std::max(a, b)] = std::min(a, b);
        }
    }
    std::map<std::size_t, std::size_t> block_of;
    for (std::size_t z = 0; z < set.zones.size(); ++z) {
        const auto [found, is_new] = block_of.try_emplace(first_of(z), grid.blocks.size());
        if (is_new)
            grid.blocks.push_back(
                {static_cast<int>(grid.blocks.size()) + 1, set.region, {}, {}, set.group, set.material});
        grid.blocks[found->second].zones.push_back(set.zones[z]);
    }
}

} // namespace kaya
