#include "geometry/mesh/cell_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace kaya {
namespace {

GridEdge grid_edge(const Polyhedron& block, const std::vector<int>& numbers, const std::array<int, 8>& corner, int axis,
                   int begin) {
    const int from = corner[begin], to = corner[begin | 1 << axis];
    const int a = numbers[from], b = numbers[to];
    return {{std::min(a, b), std::max(a, b)}, a > b, block.vertices[from], block.vertices[to]};
}

GridEdges grid_edges(const Polyhedron& block, const std::vector<int>& numbers, const std::array<int, 8>& corner) {
    GridEdges edges;
    for (int axis = 0; axis < 3; ++axis) {
        std::size_t count = 0;
        for (int c = 0; c < 8; ++c)
            if (!(c & 1 << axis)) edges[axis][count++] = grid_edge(block, numbers, corner, axis, c);
    }
    return edges;
}

/// The grid with its axes in the directions of their edges.
CellBlock directed(const std::array<int, 8>& corner, const std::array<bool, 3>& turned, GridPlaces places) {
    unsigned mask = 0;
    for (unsigned axis = 0; axis < 3; ++axis)
        if (turned[axis]) mask |= 1u << axis;
    const bool mirrored = (turned[0] + turned[1] + turned[2]) % 2 == 1;
    CellBlock cells;
    for (unsigned c = 0; c < 8; ++c) {
        const unsigned from =
            mirrored ? (c & 1u) | (c & 2u) << 1 | (c & 4u) >> 1 : c; // the second and third axis change places
        cells.corner[c] = corner[from ^ mask];
    }
    if (mirrored) std::swap(places[1], places[2]);
    cells.places = std::move(places);
    return cells;
}

/// Blocks with six faces in the order of admission: finest edges first, independent of their order in the list.
struct Candidate {
    std::size_t block;
    std::array<int, 8> corner;
    std::vector<int> numbers; ///< sorted
    GridEdges edges;
    double finest = 0;
    bool admitted = false;
};

std::vector<Candidate> candidates(const std::vector<Polyhedron>& blocks, const std::vector<std::vector<int>>& numbers,
                                  const EdgeField& field) {
    std::vector<Candidate> result;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (numbers[b].empty()) continue;
        const auto corner = hexahedron_corners(blocks[b]);
        if (!corner) continue;
        Candidate one{b, *corner, numbers[b], grid_edges(blocks[b], numbers[b], *corner)};
        std::ranges::sort(one.numbers);
        double least = std::numeric_limits<double>::infinity();
        for (const auto& row : one.edges)
            for (const GridEdge& edge : row) least = std::min(least, EdgeParts(field, edge.from, edge.to).mean());
        constexpr double grain = 1e6; // values that differ by rounding only are equal
        one.finest = std::round(grain * least);
        result.push_back(std::move(one));
    }
    std::ranges::sort(result, [](const Candidate& a, const Candidate& b) {
        return std::tie(a.finest, a.numbers) < std::tie(b.finest, b.numbers);
    });
    return result;
}

/// Continues directions through faces shared by two blocks of cells.
void go_on(const std::vector<Candidate>& admitted, const std::vector<std::vector<int>>& numbers, EdgeClasses& classes) {
    struct Side {
        const GridEdge* across;
        int end; ///< of its axis
    };
    std::map<std::array<int, 4>, std::vector<Side>> sides;
    for (const Candidate& one : admitted) {
        if (!one.admitted) continue;
        for (int axis = 0; axis < 3; ++axis)
            for (int end = 0; end < 2; ++end) {
                std::array<int, 4> face{};
                std::size_t count = 0;
                for (int c = 0; c < 8; ++c)
                    if ((c >> axis & 1) == end) face[count++] = numbers[one.block][one.corner[c]];
                std::ranges::sort(face);
                sides[face].push_back({&one.edges[axis][0], end});
            }
    }
    for (const auto& [face, pair] : sides)
        if (pair.size() == 2) classes.follow(*pair[0].across, *pair[1].across, pair[0].end == pair[1].end);
}

} // namespace

std::vector<std::optional<CellBlock>> cell_blocks(const std::vector<Polyhedron>& blocks,
                                                  const std::vector<std::vector<int>>& numbers,
                                                  std::map<SharedEdge, std::vector<double>> given,
                                                  const EdgeField& field) {
    EdgeClasses classes(std::move(given), field);
    std::vector<Candidate> all = candidates(blocks, numbers, field);
    for (Candidate& one : all) one.admitted = classes.admit(one.edges);
    go_on(all, numbers, classes);
    std::vector<std::optional<CellBlock>> cells(blocks.size());
    for (const Candidate& one : all) {
        if (!one.admitted) continue;
        std::array<bool, 3> turned;
        GridPlaces places;
        for (int axis = 0; axis < 3; ++axis) {
            turned[axis] = classes.is_turned(one.edges[axis][0]);
            places[axis] = classes.division(one.edges[axis][0]);
        }
        cells[one.block] = directed(one.corner, turned, std::move(places));
    }
    return cells;
}

} // namespace kaya
