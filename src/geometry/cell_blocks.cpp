#include "geometry/cell_blocks.hpp"

#include "geometry/hexahedron.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {
namespace {

/// Edges in classes of one direction and one number of parts.
class EdgeClasses {
public:
    /// False when the two would have to have opposite directions to what is known of them. `turned`: one begins where the other ends.
    bool unite(SharedEdge a, SharedEdge b, bool turned, double length_a, double length_b) {
        auto [ra, ta] = root(member(a, length_a));
        auto [rb, tb] = root(member(b, length_b));
        if (ra == rb) return (ta != tb) == turned;
        if (edges_[rb] < edges_[ra]) std::swap(ra, rb); // the lowest edge is the root
        parent_[rb] = ra;
        turned_[rb] = (ta != tb) != turned;
        return true;
    }
    /// Whether an edge has the direction from its higher end to its lower one.
    bool turned(SharedEdge e) { return root(numbers_.at(e)).second; }

    /// Mean lengths over classes.
    void close() {
        sum_.assign(edges_.size(), 0);
        count_.assign(edges_.size(), 0);
        for (const auto& [edge, number] : numbers_) {
            const int r = root(number).first;
            sum_[r] += lengths_[number];
            ++count_[r];
        }
    }
    int class_of(SharedEdge e) { return root(numbers_.at(e)).first; }
    double mean_length(SharedEdge e) {
        const int r = class_of(e);
        return sum_[r] / count_[r];
    }
    const std::map<SharedEdge, int>& numbers() const { return numbers_; }

private:
    int member(SharedEdge e, double length) {
        const auto [found, fresh] = numbers_.emplace(e, static_cast<int>(edges_.size()));
        if (fresh) {
            edges_.push_back(e);
            lengths_.push_back(length);
            parent_.push_back(found->second);
            turned_.push_back(false);
        }
        return found->second;
    }
    /// The root, and whether the member's direction is against that of the root.
    std::pair<int, bool> root(int number) {
        int r = number;
        bool turned = false;
        while (parent_[r] != r) {
            turned = turned != turned_[r];
            r = parent_[r];
        }
        for (int n = number; parent_[n] != n;) { // shorten the way
            const int next = parent_[n];
            const bool rest = turned != turned_[n];
            parent_[n] = r;
            turned_[n] = turned;
            turned = rest;
            n = next;
        }
        return {r, turned_of(number, r)};
    }
    bool turned_of(int number, int r) const { return number != r && turned_[number]; }

    std::map<SharedEdge, int> numbers_;
    std::vector<SharedEdge> edges_;
    std::vector<double> lengths_, sum_;
    std::vector<int> parent_, count_;
    std::vector<bool> turned_;
};

/// An edge of a grid along an axis, from the end where the axis begins.
struct GridEdge {
    SharedEdge edge;
    bool turned; ///< against the direction from the lower number to the higher
    double length;
};

GridEdge grid_edge(const Polyhedron& block, const std::vector<int>& numbers, const std::array<int, 8>& corner, int axis,
                   int begin) {
    const int from = corner[begin], to = corner[begin | 1 << axis];
    const int a = numbers[from], b = numbers[to];
    return {{std::min(a, b), std::max(a, b)}, a > b, (block.vertices[from] - block.vertices[to]).norm()};
}

/// The grid with its axes in the directions of their edges.
CellBlock directed(const std::array<int, 8>& corner, const std::array<bool, 3>& turned,
                   const std::array<int, 3>& parts) {
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
    cells.parts = mirrored ? std::array{parts[0], parts[2], parts[1]} : parts;
    return cells;
}

} // namespace

int parts_of(double length, double edge) {
    // Lengths that are an odd number of half edges are divided alike whatever rounding does to them.
    return std::max(1, static_cast<int>(std::lround(length / edge + 1e-6)));
}

std::vector<std::optional<CellBlock>> cell_blocks(const std::vector<Polyhedron>& blocks,
                                                  const std::vector<std::vector<int>>& numbers,
                                                  const std::map<SharedEdge, int>& given, double edge) {
    std::vector<std::optional<CellBlock>> cells(blocks.size());
    std::vector<std::optional<std::array<int, 8>>> corners(blocks.size());
    EdgeClasses classes;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (numbers[b].empty()) continue;
        corners[b] = hexahedron_corners(blocks[b]);
        if (!corners[b]) continue;
        bool fits = true;
        for (int axis = 0; axis < 3; ++axis) {
            const GridEdge first = grid_edge(blocks[b], numbers[b], *corners[b], axis, 0);
            for (int c = 1; c < 8; ++c) {
                if (c & 1 << axis) continue;
                const GridEdge other = grid_edge(blocks[b], numbers[b], *corners[b], axis, c);
                fits &= classes.unite(first.edge, other.edge, first.turned != other.turned, first.length, other.length);
            }
        }
        if (!fits) corners[b].reset();
    }
    classes.close();
    std::map<int, int> given_parts; // of classes, by that of their lowest edge
    for (const auto& [shared, parts] : given)
        if (classes.numbers().contains(shared)) given_parts.emplace(classes.class_of(shared), parts);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!corners[b]) continue;
        std::array<bool, 3> turned;
        std::array<int, 3> parts;
        for (int axis = 0; axis < 3; ++axis) {
            const GridEdge first = grid_edge(blocks[b], numbers[b], *corners[b], axis, 0);
            turned[axis] = classes.turned(first.edge) != first.turned;
            const auto known = given_parts.find(classes.class_of(first.edge));
            parts[axis] = known != given_parts.end() ? known->second : parts_of(classes.mean_length(first.edge), edge);
        }
        cells[b] = directed(*corners[b], turned, parts);
    }
    return cells;
}

} // namespace kaya
