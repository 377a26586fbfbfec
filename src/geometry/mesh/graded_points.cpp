#include "geometry/mesh/graded_points.hpp"

#include "base/stop_point.hpp"
#include "geometry/mesh/mesh_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace kaya {
namespace {

/// From one lattice to the next finer one.
constexpr double level_ratio = 0.7071067811865476;
/// Least distance of two points of different lattices, in parts of their mean edge. Points of one lattice keep it, but rounding can create
/// one twice where boxes meet.
constexpr double least_distance = 0.72, same_lattice = 0.3;

struct Candidate {
    Vec3 place;
    double edge;
    int level; ///< 0 is the coarsest
};

double distance(const Candidate& a, const Candidate& b) {
    return 0.5 * (a.level == b.level ? same_lattice : least_distance) * (a.edge + b.edge);
}

/// Finds lattice points in boxes that are divided until edges are nearly uniform in each.
class Search {
public:
    Search(const Vec3& low, const Vec3& high, const Spacing& spacing, const Room& room)
        : anchor_(0.5 * (low + high)), flat_(low.z() == high.z()), spacing_(spacing), room_(room),
          steepness_(spacing.finer.empty() ? spacing.change : std::max(spacing.change, Spacing::growth)) {
        const Vec3 half = 0.5 * (high - low);
        coarsest_ = spacing.field(anchor_) + spacing.change * half.norm();
        visit(anchor_, half, spacing.finer);
    }
    std::vector<Candidate> found;

private:
    double edge_at(const Vec3& x, const std::vector<FinePlace>& finer) const {
        double edge = spacing_.field(x);
        for (const FinePlace& f : finer) edge = std::min(edge, f.edge + Spacing::growth * (x - f.place).norm());
        return edge;
    }

    /// Of the edge: the distance that makes no difference.
    static constexpr double narrow = 0.01;

    void visit(const Vec3& centre, const Vec3& half, const std::vector<FinePlace>& finer) {
        stops_.pass();
        const double reach = half.norm();
        if (room_.depth(centre) < -reach) return; // all of this box is outside
        const double edge = edge_at(centre, finer);
        std::vector<FinePlace> near; // that can be the finest somewhere in this box
        for (const FinePlace& f : finer)
            if (f.edge + Spacing::growth * ((centre - f.place).norm() - reach) <= edge + steepness_ * reach)
                near.push_back(f);
        const double least = edge - steepness_ * reach;
        if (least < 0.5 * edge && reach > narrow * edge) {
            // A box that is narrow in a direction is not halved in it: a splinter of 20 km by 1 mm would be cut into 10^10 boxes.
            Vec3 part = half, side = Vec3::Zero();
            for (int k = 0; k < 3; ++k)
                if (half[k] > narrow * edge) part[k] = side[k] = 0.5 * half[k];
            for (int i = 0; i < 8; ++i) {
                Vec3 there = centre;
                bool twice = false; // the same box as before
                for (int k = 0; k < 3; ++k) {
                    const bool upper = (i >> k & 1) != 0;
                    twice = twice || (upper && side[k] == 0);
                    there[k] += upper ? side[k] : -side[k];
                }
                if (!twice) visit(there, part, near);
            }
            return;
        }
        const auto level_of = [&](double e) { return std::log(e / coarsest_) / std::log(level_ratio); };
        const int first = static_cast<int>(std::floor(level_of(edge + steepness_ * reach))),
                  last = static_cast<int>(std::ceil(level_of(least)));
        for (int level = std::max(first, 0); level <= last; ++level) lattice(centre, half, level, near);
    }

    /// Lattice points of one level in a box, without its upper sides.
    void lattice(const Vec3& centre, const Vec3& half, int level, const std::vector<FinePlace>& finer) {
        const double size = coarsest_ * std::pow(level_ratio, level);
        const Vec3 cell = flat_ ? Vec3(size, std::sqrt(3.0) * size, 1) : Vec3::Constant(lattice_cell(size));
        Cells cells{cell, centre - half, centre + half, level};
        for (int k = 0; k < (flat_ ? 2 : 3); ++k) {
            cells.from[k] = static_cast<std::int64_t>(std::floor((cells.low[k] - anchor_[k]) / cell[k])) - 1;
            cells.to[k] = static_cast<std::int64_t>(std::ceil((cells.high[k] - anchor_[k]) / cell[k]));
        }
        visit(cells, finer);
    }

    /// Cells of a lattice in a box, each with a point at its lower corner and one in its middle.
    struct Cells {
        Vec3 size, low, high; ///< the box is from low to high
        int level;
        std::array<std::int64_t, 3> from{}, to{}; ///< inclusive
    };

    /// In the order of z, y and x, whatever is left out because it is outside.
    void visit(const Cells& cells, const std::vector<FinePlace>& finer) {
        stops_.pass();
        /// Shorter rows are not worth a division.
        constexpr std::int64_t short_row = 8;
        int widest = 2; // the slowest index that has more than one value
        while (widest > 0 && cells.from[widest] == cells.to[widest]) --widest;
        if (widest == 0 && cells.to[0] - cells.from[0] < short_row) {
            for (std::int64_t i = cells.from[0]; i <= cells.to[0]; ++i)
                for (const double shift : {0.0, 0.5}) {
                    const Vec3 steps(static_cast<double>(i) + shift, static_cast<double>(cells.from[1]) + shift,
                                     flat_ ? 0 : static_cast<double>(cells.from[2]) + shift);
                    consider(anchor_ + steps.cwiseProduct(cells.size), cells, finer);
                }
            return;
        }
        Vec3 first, last;
        for (int k = 0; k < 3; ++k) {
            first[k] = static_cast<double>(cells.from[k]);
            last[k] = static_cast<double>(cells.to[k]) + 0.5;
        }
        if (flat_) last.z() = 0;
        const Vec3 middle = anchor_ + (0.5 * (first + last)).cwiseProduct(cells.size);
        if (room_.depth(middle) < -0.5 * (last - first).cwiseProduct(cells.size).norm()) return;
        Cells part = cells;
        part.to[widest] = cells.from[widest] + (cells.to[widest] - cells.from[widest]) / 2;
        visit(part, finer);
        part.from[widest] = part.to[widest] + 1;
        part.to[widest] = cells.to[widest];
        visit(part, finer);
    }

    void consider(const Vec3& x, const Cells& cells, const std::vector<FinePlace>& finer) {
        for (int k = 0; k < (flat_ ? 2 : 3); ++k)
            if (x[k] < cells.low[k] || x[k] >= cells.high[k]) return;
        const double edge = edge_at(x, finer);
        if (std::lround(std::log(edge / coarsest_) / std::log(level_ratio)) != cells.level) return;
        if (!(room_.depth(x) >= room_.clearance * edge)) return;
        found.push_back({x, edge, cells.level});
    }

    Vec3 anchor_;
    bool flat_;
    const Spacing& spacing_;
    const Room& room_;
    double steepness_, coarsest_;
    StopPoints stops_;
};

/// Points that keep their distance, finest first.
class Kept {
public:
    explicit Kept(double cell) : cell_(cell) {}

    bool has_room(const Candidate& c) const {
        const double reach = least_distance * c.edge;
        const Key low = key(c.place - Vec3::Constant(reach)), high = key(c.place + Vec3::Constant(reach));
        for (auto i = low[0]; i <= high[0]; ++i)
            for (auto j = low[1]; j <= high[1]; ++j)
                for (auto k = low[2]; k <= high[2]; ++k) {
                    const auto there = cells_.find({i, j, k});
                    if (there == cells_.end()) continue;
                    for (const Candidate& other : there->second)
                        if ((other.place - c.place).norm() < distance(other, c)) return false;
                }
        return true;
    }
    void add(const Candidate& c) { cells_[key(c.place)].push_back(c); }

private:
    using Key = std::array<std::int64_t, 3>;
    Key key(const Vec3& x) const {
        Key key;
        for (int k = 0; k < 3; ++k) key[k] = static_cast<std::int64_t>(std::floor(x[k] / cell_));
        return key;
    }
    double cell_;
    std::map<Key, std::vector<Candidate>> cells_;
};

} // namespace

std::vector<Vec3> graded_points(const Vec3& low, const Vec3& high, const Spacing& spacing, const Room& room) {
    std::vector<Candidate> candidates = Search(low, high, spacing, room).found;
    std::ranges::stable_sort(candidates, [](const Candidate& a, const Candidate& b) { return a.level > b.level; });
    std::vector<Vec3> points;
    if (candidates.empty()) return points;
    // Keys of far places would not be whole numbers of 64 bits if the finest edge were the cell.
    Kept kept(std::max(candidates.back().edge, 1e-9 * (high.cwiseAbs().cwiseMax(low.cwiseAbs())).maxCoeff()));
    for (const Candidate& c : candidates) {
        if (!kept.has_room(c)) continue;
        kept.add(c);
        points.push_back(c.place);
    }
    return points;
}

} // namespace kaya
