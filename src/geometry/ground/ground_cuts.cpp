#include "geometry/ground/ground_cuts.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/plan_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace kaya {

namespace {

constexpr std::size_t most_pieces = 2'000'000;
/// Rock above or below all of the surface is taken off first when it is thicker than this part of the surface's own height.
constexpr double worth_a_level = 0.5;

using Polygon = std::vector<Vec3>;

/// The part of a triangle over a convex outline.
Polygon clipped(Polygon polygon, const Polygon& outline) {
    for (std::size_t k = 0; k < outline.size() && !polygon.empty(); ++k) {
        const Vec3 &a = outline[k], &b = outline[(k + 1) % outline.size()];
        Polygon kept;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
            const double at = plan_cross(a, b, p), next = plan_cross(a, b, q);
            if (at >= 0) kept.push_back(p);
            if ((at > 0 && next < 0) || (at < 0 && next > 0)) kept.push_back(p + at / (at - next) * (q - p));
        }
        polygon = std::move(kept);
    }
    return polygon;
}

double plan_area(const Polygon& polygon) {
    double sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) sum += plan_cross(polygon[0], polygon[i - 1], polygon[i]);
    return 0.5 * sum;
}

/// A part of the surface over one block.
struct Patch {
    Plane plane;     ///< normal upward
    Polygon outline; ///< in the plane
    int triangle = 0;

    double height(const Vec3& at) const {
        const Vec3& n = plane.normal;
        return plane.origin.z() - (n.x() * (at.x() - plane.origin.x()) + n.y() * (at.y() - plane.origin.y())) / n.z();
    }
};

struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    void add(double z) { low = std::min(low, z), high = std::max(high, z); }
};

class Cutter {
public:
    Cutter(const Ground& ground, int id, double thinnest, SidedBlocks& result)
        : ground_(ground), id_(id), thinnest_(thinnest), result_(result) {}

    struct Piece {
        Polyhedron body;
        bool above;
    };
    std::vector<Piece> pieces_of(const Polyhedron& block) {
        pieces_.clear();
        split(block, 0);
        return std::move(pieces_);
    }

    /// Whether the rim of the surface passes through the inside of a block, where its planes are continued.
    bool ends_within(const Polyhedron& block) const {
        const Polygon outline = plan_hull(block.vertices);
        Span z;
        for (const Vec3& v : block.vertices) z.add(v.z());
        return std::ranges::any_of(ground_.rim(), [&](const std::array<int, 2>& edge) {
            const Vec3 &from = ground_.corners()[static_cast<std::size_t>(edge[0])],
                       &to = ground_.corners()[static_cast<std::size_t>(edge[1])];
            double first = 0, last = 1; // of the part of the edge inside
            const auto keep = [&](double at_from, double at_to) {
                if (at_from <= 0 && at_to <= 0) last = -1;
                else if (at_from < 0) first = std::max(first, at_from / (at_from - at_to));
                else if (at_to < 0) last = std::min(last, at_from / (at_from - at_to));
            };
            keep(from.z() - z.low - thinnest_, to.z() - z.low - thinnest_);
            keep(z.high - thinnest_ - from.z(), z.high - thinnest_ - to.z());
            for (std::size_t k = 0; k < outline.size(); ++k) {
                const Vec3 &a = outline[k], &b = outline[(k + 1) % outline.size()];
                const double side = thinnest_ * std::hypot(b.x() - a.x(), b.y() - a.y());
                keep(plan_cross(a, b, from) - side, plan_cross(a, b, to) - side);
            }
            return first < last;
        });
    }

private:
    std::vector<Patch> patches_over(const Polyhedron& body) const {
        const Polygon outline = plan_hull(body.vertices);
        std::vector<Patch> patches;
        if (outline.size() < 3) return patches;
        Span x, y;
        for (const Vec3& v : outline) x.add(v.x()), y.add(v.y());
        const double smallest = 1e-9 * plan_area(outline);
        for (const int i : ground_.near(x.low, x.high, y.low, y.high)) {
            Polygon triangle;
            for (const int corner : ground_.triangles()[static_cast<std::size_t>(i)])
                triangle.push_back(ground_.corners()[static_cast<std::size_t>(corner)]);
            const Plane plane{(triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized(), triangle[0]};
            Polygon part = clipped(std::move(triangle), outline);
            if (part.size() >= 3 && plan_area(part) > smallest) patches.push_back({plane, std::move(part), i});
        }
        return patches;
    }

    /// A piece that no cut reaches belongs to the side with most of its middle.
    void keep(Polyhedron body, bool above) {
        if (pieces_.size() >= most_pieces)
            throw Diagnostic(fmt::format("the surface would cut a block into more than {} pieces", most_pieces),
                             "use a surface with fewer triangles, or larger ones");
        pieces_.push_back({std::move(body), above});
    }
    void keep_by_middle(Polyhedron body) {
        const Vec3 middle = mass_properties(body).centroid;
        keep(std::move(body), middle.z() > ground_.height_beyond(middle.x(), middle.y()));
    }

    /// Both parts of a cut are processed further; false when the plane misses.
    bool halve(const Polyhedron& body, const Plane& plane, int depth) {
        Cut parts = cut(body, plane, id_, thinnest_);
        if (parts.outcome == CutOutcome::sliver) ++result_.blocks.slivers;
        if (parts.outcome != CutOutcome::cut) return false;
        split(parts.above, depth + 1);
        split(parts.below, depth + 1);
        return true;
    }

    /// Whether all patches form the lower envelope of their planes (a ridge; `sign` 1) or the upper one (a valley; -1) within the body. At
    /// its top or bottom the surface is only known to lie beyond.
    bool is_envelope(const std::vector<Patch>& all, const std::vector<const Patch*>& planes, const Span& z,
                     int sign) const {
        for (const Patch& patch : all)
            for (const Vec3& corner : patch.outline) {
                double height = sign * std::numeric_limits<double>::infinity();
                for (const Patch* p : planes)
                    height = sign > 0 ? std::min(height, p->height(corner)) : std::max(height, p->height(corner));
                const double here = std::clamp(corner.z(), z.low, z.high);
                if (std::abs(std::clamp(height, z.low, z.high) - here) > thinnest_) return false;
            }
        return true;
    }

    void carve(Polyhedron body, const std::vector<const Patch*>& planes, bool ridge) {
        for (const Patch* patch : planes) {
            Cut parts = cut(body, patch->plane, id_, thinnest_);
            if (parts.outcome == CutOutcome::sliver) {
                ++result_.blocks.slivers;
                parts.outcome =
                    patch->plane.distance(mass_properties(body).centroid) > 0 ? CutOutcome::above : CutOutcome::below;
            }
            // Above one plane of a ridge is above the ground, below one of a valley is below it.
            if (parts.outcome == (ridge ? CutOutcome::above : CutOutcome::below)) return keep(std::move(body), ridge);
            if (parts.outcome != CutOutcome::cut) continue;
            keep(std::move(ridge ? parts.above : parts.below), ridge);
            body = std::move(ridge ? parts.below : parts.above);
        }
        keep(std::move(body), !ridge);
    }

    void split(const Polyhedron& body, int depth) {
        constexpr int deepest = 200;
        const std::vector<Patch> patches = patches_over(body);
        if (patches.empty() || depth > deepest) return keep_by_middle(body);
        Span z, surface;
        for (const Vec3& v : body.vertices) z.add(v.z());
        for (const Patch& patch : patches)
            for (const Vec3& corner : patch.outline) surface.add(corner.z());
        if (surface.low >= z.high - thinnest_) return keep(body, false);
        if (surface.high <= z.low + thinnest_) return keep(body, true);

        // Planes that pass through the body's range of heights, each once.
        std::vector<const Patch*> planes;
        for (const Patch& patch : patches) {
            Span own;
            for (const Vec3& corner : patch.outline) own.add(corner.z());
            if (own.low >= z.high - thinnest_ || own.high <= z.low + thinnest_) continue;
            const bool known = std::ranges::any_of(planes, [&](const Patch* other) {
                return std::ranges::all_of(patch.outline, [&](const Vec3& corner) {
                    return std::abs(other->height(corner) - corner.z()) <= thinnest_;
                });
            });
            if (!known) planes.push_back(&patch);
        }
        if (planes.empty()) return split_apart(body, patches, depth);
        if (planes.size() <= 64) {
            if (is_envelope(patches, planes, z, 1)) return carve(body, planes, true);
            if (is_envelope(patches, planes, z, -1)) return carve(body, planes, false);
        }
        // Floors of benches and pits part the rock into layers.
        for (const Patch* patch : planes)
            if (patch->plane.normal.z() == 1 && halve(body, patch->plane, depth)) return;
        const double thick = worth_a_level * (surface.high - surface.low);
        if (z.high - surface.high > thick && halve(body, {Vec3::UnitZ(), Vec3(0, 0, surface.high)}, depth)) return;
        if (surface.low - z.low > thick && halve(body, {Vec3::UnitZ(), Vec3(0, 0, surface.low)}, depth)) return;
        split_apart(body, patches, depth);
    }

    /// Upright planes along the edges of triangles, the longest over the body first.
    void split_apart(const Polyhedron& body, const std::vector<Patch>& patches, int depth) {
        struct Edge {
            double length;
            Vec3 from, along;
        };
        std::vector<Edge> edges;
        const Polygon outline = plan_hull(body.vertices);
        for (const Patch& patch : patches) {
            const auto& corners = ground_.triangles()[static_cast<std::size_t>(patch.triangle)];
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &a = ground_.corners()[static_cast<std::size_t>(corners[k])],
                           &b = ground_.corners()[static_cast<std::size_t>(corners[(k + 1) % 3])];
                // A fold between planes, counted once.
                const auto across = std::ranges::find_if(patches, [&](const Patch& other) {
                    const auto& t = ground_.triangles()[static_cast<std::size_t>(other.triangle)];
                    return other.triangle > patch.triangle && std::ranges::find(t, corners[k]) != t.end() &&
                           std::ranges::find(t, corners[(k + 1) % 3]) != t.end();
                });
                if (across == patches.end()) continue;
                const bool flat = std::ranges::all_of(across->outline, [&](const Vec3& corner) {
                    return std::abs(patch.height(corner) - corner.z()) <= thinnest_;
                });
                if (flat) continue;
                double low = 0, high = 1; // of the edge over the outline
                for (std::size_t i = 0; i < outline.size(); ++i) {
                    const double at = plan_cross(outline[i], outline[(i + 1) % outline.size()], a),
                                 end = plan_cross(outline[i], outline[(i + 1) % outline.size()], b);
                    if (at < 0 && end < 0) high = -1;
                    else if (at < 0) low = std::max(low, at / (at - end));
                    else if (end < 0) high = std::min(high, at / (at - end));
                }
                const Vec3 along(b.x() - a.x(), b.y() - a.y(), 0);
                if (high > low) edges.push_back({(high - low) * along.norm(), a, along});
            }
        }
        std::ranges::stable_sort(edges, std::ranges::greater(), &Edge::length);
        for (const Edge& edge : edges)
            if (halve(body, {Vec3(-edge.along.y(), edge.along.x(), 0).normalized(), edge.from}, depth)) return;
        // The rest is thinner than any fold: its middle decides, or the plane of the largest patch.
        const Patch& largest =
            *std::ranges::max_element(patches, {}, [](const Patch& p) { return plan_area(p.outline); });
        Cut parts = cut(body, largest.plane, id_, thinnest_);
        if (parts.outcome != CutOutcome::cut) return keep_by_middle(body);
        keep(std::move(parts.above), true);
        keep(std::move(parts.below), false);
    }

    const Ground& ground_;
    int id_;
    double thinnest_;
    SidedBlocks& result_;
    std::vector<Piece> pieces_;
};

} // namespace

SidedBlocks cut_by_ground(const std::vector<Polyhedron>& blocks, const Ground& ground, int id, double thinnest,
                          const ProgressCallback& progress) {
    SidedBlocks result;
    Cutter cutter(ground, id, thinnest, result);
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        report_progress(progress, block, blocks.size());
        auto pieces = cutter.pieces_of(blocks[block]);
        if (pieces.size() < 2) continue;
        // Cuts between pieces on one side are removed.
        const bool above = pieces.front().above;
        if (std::ranges::all_of(pieces, [above](const auto& piece) { return piece.above == above; })) continue;
        result.blocks.parents.push_back(static_cast<int>(block));
        if (cutter.ends_within(blocks[block])) result.beyond.push_back(static_cast<int>(block));
        std::stable_partition(pieces.begin(), pieces.end(), [](const auto& piece) { return !piece.above; });
        for (auto& piece : pieces) {
            result.blocks.pieces.push_back({std::move(piece.body), static_cast<int>(block)});
            result.inside.push_back(!piece.above);
        }
    }
    return result;
}

} // namespace kaya
