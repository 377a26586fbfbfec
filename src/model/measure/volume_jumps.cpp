#include "model/measure/volume_jumps.hpp"

#include "model/measure/block_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace kaya {
namespace {

constexpr double most = 4;
/// Distance of coinciding triangles, in parts of the size of the blocks.
constexpr double same_place = 1e-7;

struct Side {
    std::array<Row, 3> corners; ///< rising
    Row zone;
    bool operator<(const Side& o) const { return corners != o.corners ? corners < o.corners : zone < o.zone; }
};

class JumpSearch {
public:
    JumpSearch(const Model& model, const std::vector<Row>& blocks)
        : model_(model), wanted_(model.blocks.size(), false) {
        for (const Row b : blocks) {
            if (!model.blocks.deformable[b]) continue;
            wanted_[b] = true;
            const Box box = block_box(model, b);
            low_ = low_.cwiseMin(box.low);
            high_ = high_.cwiseMax(box.high);
        }
        const double far = std::max(low_.cwiseAbs().maxCoeff(), high_.cwiseAbs().maxCoeff());
        tolerance_ = same_place * (high_ - low_).norm() + 64 * std::numeric_limits<double>::epsilon() * far;
    }

    VolumeJumps run() {
        if (!(tolerance_ > 0) || !std::isfinite(tolerance_)) return found_; // no block has zones
        for (Row b = 0; b < static_cast<Row>(model_.blocks.size()); ++b)
            if (model_.blocks.deformable[b] && (wanted_[b] || is_near(b))) visit(b);
        return found_;
    }

private:
    bool is_near(const Vec3& x) const {
        return (x - low_).minCoeff() >= -tolerance_ && (high_ - x).minCoeff() >= -tolerance_;
    }
    bool is_near(Row block) const {
        const Span triangles = model_.blocks.triangles[block];
        for (Row t = triangles.first; t < triangles.end(); ++t)
            if (is_near(centre(model_.triangles.gridpoints[t]))) return true;
        return false;
    }
    Vec3 centre(const std::array<Row, 3>& corners) const {
        const auto& x = model_.gridpoints.position;
        return (x[corners[0]] + x[corners[1]] + x[corners[2]]) / 3;
    }

    /// Inside a block each side of a zone occurs twice in the list, on its faces once.
    void visit(Row block) {
        std::vector<Side> sides;
        const Span zones = model_.blocks.zones[block];
        for (Row z = zones.first; z < zones.end(); ++z)
            for (std::size_t out = 0; out < 4; ++out) {
                Side side{{}, z};
                for (std::size_t k = 0, i = 0; k < 4; ++k)
                    if (k != out) side.corners[i++] = model_.zones.gridpoints[z][k];
                std::ranges::sort(side.corners);
                sides.push_back(side);
            }
        std::sort(sides.begin(), sides.end());
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const bool inside = i + 1 < sides.size() && sides[i].corners == sides[i + 1].corners;
            if (inside) {
                if (wanted_[block]) compare(sides[i].zone, sides[i + 1].zone, centre(sides[i].corners));
                ++i;
            } else {
                const Vec3 place = centre(sides[i].corners);
                if (is_near(place)) across(sides[i].zone, place);
            }
        }
    }

    /// The pair with the zone of an earlier block on the other side of a face.
    void across(Row zone, const Vec3& place) {
        const Cell low = cell_of(place - Vec3::Constant(tolerance_)),
                   high = cell_of(place + Vec3::Constant(tolerance_));
        for (auto i = low[0]; i <= high[0]; ++i)
            for (auto j = low[1]; j <= high[1]; ++j)
                for (auto k = low[2]; k <= high[2]; ++k) {
                    const auto [first, last] = outer_.equal_range({i, j, k});
                    for (auto it = first; it != last; ++it) {
                        const auto& [other, there] = it->second;
                        if ((there - place).norm() > tolerance_ || !is_wanted(zone, other)) continue;
                        return compare(zone, other, place);
                    }
                }
        outer_.emplace(cell_of(place), std::pair{zone, place});
    }
    bool is_wanted(Row zone, Row other) const {
        return wanted_[model_.zones.block[zone]] || wanted_[model_.zones.block[other]];
    }

    void compare(Row a, Row b, const Vec3& place) {
        if (model_.zones.volume[a] < model_.zones.volume[b]) std::swap(a, b);
        const double ratio = model_.zones.volume[a] / model_.zones.volume[b];
        if (!(ratio > most)) return;
        ++found_.count;
        if (ratio <= found_.worst) return;
        found_.worst = ratio;
        found_.place = place;
        found_.blocks = {model_.zones.block[a], model_.zones.block[b]};
    }

    using Cell = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cell& cell) const {
            std::uint64_t h = 0;
            for (const std::int64_t k : cell)
                h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
            return h;
        }
    };
    Cell cell_of(const Vec3& x) const {
        Cell cell;
        for (int k = 0; k < 3; ++k) cell[k] = std::llround(std::floor((x[k] - low_[k]) / (4 * tolerance_)));
        return cell;
    }

    const Model& model_;
    std::vector<bool> wanted_;
    Vec3 low_ = Vec3::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
    double tolerance_ = 0;
    std::unordered_multimap<Cell, std::pair<Row, Vec3>, Hash> outer_;
    VolumeJumps found_;
};

} // namespace

VolumeJumps volume_jumps(const Model& model, const std::vector<Row>& blocks) { return JumpSearch(model, blocks).run(); }

} // namespace kaya
