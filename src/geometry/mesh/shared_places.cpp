#include "geometry/mesh/shared_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace kaya {
namespace {

/// In parts of the size of all blocks together.
constexpr double same_place = 1e-8;
/// In units of the last place of the coordinates: the resolution of a place far from the origin.
constexpr double noise = 64;

} // namespace

SharedPlaces::SharedPlaces(const std::vector<Polyhedron>& blocks) : numbers_(blocks.size()) {
    struct Vertex {
        std::size_t block, vertex;
    };
    std::vector<Vertex> vertices;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        for (std::size_t v = 0; v < blocks[b].vertices.size(); ++v) {
            vertices.push_back({b, v});
            low = low.cwiseMin(blocks[b].vertices[v]);
            high = high.cwiseMax(blocks[b].vertices[v]);
        }
    if (vertices.empty()) return;
    const double far = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    tolerance_ = same_place * (high - low).norm() + noise * std::numeric_limits<double>::epsilon() * far;
    const auto at = [&](const Vertex& v) -> const Vec3& { return blocks[v.block].vertices[v.vertex]; };
    std::ranges::sort(vertices, [&](const Vertex& a, const Vertex& b) {
        const Vec3 &x = at(a), &y = at(b);
        return std::tuple(x.x(), x.y(), x.z(), a.block, a.vertex) < std::tuple(y.x(), y.y(), y.z(), b.block, b.vertex);
    });
    for (std::size_t b = 0; b < blocks.size(); ++b) numbers_[b].resize(blocks[b].vertices.size(), -1);
    for (const Vertex& v : vertices) {
        int number = find(at(v));
        if (number < 0 || std::ranges::find(numbers_[v.block], number) != numbers_[v.block].end()) number = add(at(v));
        numbers_[v.block][v.vertex] = number;
    }
}

std::size_t SharedPlaces::Hash::operator()(const Cell& cell) const {
    std::uint64_t h = 0;
    for (const std::int64_t k : cell) h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
    return h;
}

SharedPlaces::Cell SharedPlaces::cell_of(const Vec3& x) const {
    Cell cell;
    for (int k = 0; k < 3; ++k) cell[k] = std::llround(std::floor(x[k] / (4 * tolerance_)));
    return cell;
}

int SharedPlaces::find(const Vec3& x) const {
    if (places_.empty()) return -1;
    const Cell low = cell_of(x - Vec3::Constant(tolerance_)), high = cell_of(x + Vec3::Constant(tolerance_));
    int best = -1;
    for (std::int64_t i = low[0]; i <= high[0]; ++i)
        for (std::int64_t j = low[1]; j <= high[1]; ++j)
            for (std::int64_t k = low[2]; k <= high[2]; ++k) {
                const auto [first, last] = cells_.equal_range({i, j, k});
                for (auto it = first; it != last; ++it)
                    if ((places_[it->second] - x).norm() <= tolerance_ && (best < 0 || it->second < best))
                        best = it->second;
            }
    return best;
}

int SharedPlaces::add(const Vec3& x) {
    const int number = static_cast<int>(places_.size());
    places_.push_back(x);
    cells_.emplace(cell_of(x), number);
    return number;
}

} // namespace kaya
