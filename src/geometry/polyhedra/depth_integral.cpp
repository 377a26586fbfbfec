#include "geometry/polyhedra/depth_integral.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace kaya {

namespace {

/// Integrals over polygons: of m n, and of m x x n, where m is the depth and n the outward normal.
struct Push {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    Vec3 of_end = Vec3::Zero(); ///< the part of the force where the end of the Apex is the nearest
};

/// A point in which the depths below all near faces vanish. One of them, the end, may have another point, so that a strip with two ends need
/// not be divided. docs/theory/contacts.md, equation (9a).
struct Apex {
    Vec3 point;
    std::size_t end;           ///< place of the face among all; their count if all near ones meet in the point
    Vec3 shift = Vec3::Zero(); ///< from the point to that of the end
};

/// Adds a polygon over which one face, or the end, is the nearest.
void add_polygon(const std::vector<Vec3>& polygon, const HalfSpace& face, bool is_end, Push& sum) {
    if (polygon.size() < 3) return;
    const Vec3& a = polygon[0];
    const double pa = face.depth(a);
    Vec3 force = Vec3::Zero(), moment = sum.moment; // not in memory, where they might overlap the polygon
    for (std::size_t i = 1, last = polygon.size() - 1; i < last; ++i) {
        const Vec3 &b = polygon[i], &c = polygon[i + 1];
        const Vec3 area = 0.5 * (b - a).cross(c - a);
        const double pb = face.depth(b), pc = face.depth(c), whole = pa + pb + pc;
        force += whole / 3 * area;
        moment += (pa * a + pb * b + pc * c + whole * (a + b + c)).cross(area) / 12;
    }
    sum.force += force;
    sum.moment = moment;
    if (is_end) sum.of_end += force;
}

/// The middle of a region's vertices and how far the farthest is from there.
struct Extent {
    Vec3 middle = Vec3::Zero();
    double square = 0; ///< of the distance

    explicit Extent(const ConvexClip& region) {
        region.each_vertex([&](const Vec3& x) { middle += x; });
        middle /= static_cast<double>(region.vertex_count());
        region.each_vertex([&](const Vec3& x) { square = std::max(square, (x - middle).squaredNorm()); });
    }

    /// Whether toward/divisor is short: the farther a point is, the more digits of the integral it costs.
    bool reaches(const Vec3& toward, double divisor) const {
        constexpr double farthest = 30; // sizes of the region: costs a digit
        return toward.squaredNorm() < farthest * farthest * divisor * divisor * square;
    }
};

/// The depth m = min d_i is linear between the planes in which two depths are equal. About a point p in which all d_i vanish it is
/// homogeneous, div((x - p) m) = 4 m, so that its integral is a fourth of that of m (x - p) . n over the surface. Where there is no such point
/// nearby, the region is divided by the plane between two of its faces. docs/theory/contacts.md, equation (9a).
class DepthIntegral {
public:
    /// Faces, by their places among all.
    using List = std::span<std::size_t>;

    /// No place of the part is deeper than `deepest`.
    DepthIntegral(const std::vector<HalfSpace>& faces, FaceOrigin own, double sense, double deepest,
                  DepthScratch& scratch)
        : faces_(faces), own_(own), pushed_(own == FaceOrigin::subject ? FaceOrigin::clipper : FaceOrigin::subject),
          sense_(sense), deepest_(deepest), work_(scratch) {
        // A division leaves one face less. The list of a part is behind that of what was divided.
        const std::size_t levels = scratch.near.size();
        scratch.near.resize(levels * (levels + 1) / 2);
        if (work_.halves.size() < levels) work_.halves.resize(levels);
        if (work_.loops.size() < 2 * levels + 1) work_.loops.resize(2 * levels + 1);
    }

    /// The region is nearest to the faces of the list; `level` counts divisions.
    void add(const ConvexClip& region, List near, std::size_t level) {
        if (const auto apex = apex_of(region, near)) add_surface(region, near, *apex);
        else divide(region, near, level);
    }

    const OverlapGradient& sum() const { return sum_; }

private:
    /// A list without one of its places, behind it.
    static List without(List list, std::size_t left) {
        const List rest(list.data() + list.size(), list.size() - 1);
        for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = list[i < left ? i : i + 1];
        return rest;
    }

    /// The point of a region's near faces, or two of them; none where they are not near the region.
    std::optional<Apex> apex_of(const ConvexClip& region, List near) {
        const Extent extent(region);
        if (const auto point = common_point(region, near, extent)) return Apex{*point, faces_.size()};
        return near.size() == 3 || near.size() == 4 ? apex_with_end(region, near, extent) : std::nullopt;
    }

    /// A point of all near faces but one, the end, for which it is shifted such that depths are equal where the end meets the others. The face
    /// most opposite to the end must not meet it within the depth of the region.
    std::optional<Apex> apex_with_end(const ConvexClip& region, List near, const Extent& extent) {
        const auto [one, two] = most_opposite(near);
        std::swap(near[two], near.back());
        const List rest = near.first(near.size() - 1);
        const std::size_t end = near.back();
        if (closest(region, faces_[rest[one]], faces_[end]) <= deepest_) return std::nullopt;
        const auto point = common_point(region, rest, extent);
        if (!point) return std::nullopt;
        std::array<std::size_t, 2> other{};
        std::size_t others = 0;
        for (std::size_t i = 0; i < rest.size(); ++i)
            if (i != one) other[others++] = rest[i];
        const Vec3 &n = faces_[end].normal, &u = faces_[other[0]].normal;
        Vec3 toward = n + u;
        double divisor = 1 + n.dot(u);
        if (others == 2) {
            const Vec3 &v = faces_[other[1]].normal, across = u.cross(v);
            toward = across + v.cross(n) + n.cross(u);
            divisor = n.dot(across);
        }
        toward *= faces_[end].depth(*point);
        if (!extent.reaches(toward, divisor)) return std::nullopt;
        return Apex{*point, end, toward / divisor};
    }

    /// Half of the smallest distance between two planes that a region has: where their depths are equal, they are at least this.
    static double closest(const ConvexClip& region, const HalfSpace& one, const HalfSpace& two) {
        double least = std::numeric_limits<double>::infinity();
        region.each_vertex([&](const Vec3& x) { least = std::min(least, one.depth(x) + two.depth(x)); });
        return 0.5 * least;
    }

    /// A point in which the depths below all faces of a list vanish, not far from the region.
    std::optional<Vec3> common_point(const ConvexClip& region, std::span<const std::size_t> list,
                                     const Extent& extent) const {
        const Vec3& middle = extent.middle;
        const HalfSpace& one = faces_[list[0]];
        const double d1 = one.depth(middle);
        if (list.size() == 1) return middle + d1 * one.normal;
        Vec3 toward;
        double divisor = 0; // `toward` over it leads from the middle to the point
        if (list.size() == 2) {
            const HalfSpace& two = faces_[list[1]];
            const double d2 = two.depth(middle), cosine = one.normal.dot(two.normal);
            toward = (d1 - cosine * d2) * one.normal + (d2 - cosine * d1) * two.normal;
            divisor = one.normal.cross(two.normal).squaredNorm();
        } else {
            const auto [second, third] = most_apart(list);
            const HalfSpace &two = faces_[second], &three = faces_[third];
            const Vec3 across = two.normal.cross(three.normal);
            toward = d1 * across + two.depth(middle) * three.normal.cross(one.normal) +
                     three.depth(middle) * one.normal.cross(two.normal);
            divisor = one.normal.dot(across);
        }
        if (!extent.reaches(toward, divisor)) return std::nullopt;
        const Vec3 point = middle + toward / divisor;
        return list.size() > 3 && !all_meet(region, list, point) ? std::nullopt : std::optional(point);
    }

    /// Two faces of a list that define a point with its first one.
    std::pair<std::size_t, std::size_t> most_apart(std::span<const std::size_t> list) const {
        if (list.size() == 3) return {list[1], list[2]};
        const Vec3& one = faces_[list[0]].normal;
        const auto rest = list.subspan(1);
        const auto best = [&](const auto& measure) {
            return *std::max_element(rest.begin(), rest.end(),
                                     [&](std::size_t a, std::size_t b) { return measure(a) < measure(b); });
        };
        const std::size_t second = best([&](std::size_t i) { return one.cross(faces_[i].normal).squaredNorm(); });
        const Vec3 across = one.cross(faces_[second].normal);
        return {second, best([&](std::size_t i) { return std::abs(across.dot(faces_[i].normal)); })};
    }

    /// Whether the planes of all faces pass through a point, such as the tip of a pyramid. What they miss it by is the error of the mean depth.
    bool all_meet(const ConvexClip& region, std::span<const std::size_t> list, const Vec3& point) const {
        constexpr double precision = 1e-12; // of the greatest depth
        double deepest = 0;
        region.each_vertex([&](const Vec3& x) {
            double depth = std::numeric_limits<double>::infinity();
            for (const std::size_t i : list) depth = std::min(depth, faces_[i].depth(x));
            deepest = std::max(deepest, depth);
        });
        return std::all_of(list.begin(), list.end(),
                           [&](std::size_t i) { return std::abs(faces_[i].depth(point)) <= precision * deepest; });
    }

    /// The places in a list of the two faces that look most in opposite directions, the later one second.
    std::pair<std::size_t, std::size_t> most_opposite(std::span<const std::size_t> list) const {
        std::pair<std::size_t, std::size_t> best{0, 1};
        double least = 2;
        for (std::size_t i = 0; i < list.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (const double cosine = faces_[list[i]].normal.dot(faces_[list[j]].normal); cosine < least) {
                    least = cosine;
                    best = {j, i};
                }
        return best;
    }

    /// Divides the region between the two faces that look most in opposite directions.
    void divide(const ConvexClip& region, List near, std::size_t level) {
        const auto [one, two] = most_opposite(near);
        for (const auto& [kept, left] : {std::pair(one, two), std::pair(two, one)}) {
            const HalfSpace &here = faces_[near[kept]], &there = faces_[near[left]];
            ConvexClip& half = work_.halves[level];
            half.copy(region);
            half.clip({there.normal - here.normal, there.reach - here.reach}, FaceOrigin::inner);
            if (!half.empty()) add(half, without(near, left), level + 1);
        }
    }

    void add_surface(const ConvexClip& region, List near, const Apex& apex) {
        const bool below_all = faces_.size() > 1; // then the depth vanishes on the body's own faces
        for (std::size_t f = 0; f < region.face_count(); ++f) {
            const FaceOrigin origin = region.origin(f);
            if (below_all && origin == own_) continue;
            std::vector<Vec3>& loop = work_.loops[0];
            loop.resize(static_cast<std::size_t>(region.corner_count(f)));
            for (int i = 0; i < region.corner_count(f); ++i) loop[static_cast<std::size_t>(i)] = region.corner(f, i);
            Push push;
            add_parts(0, near, 0, apex.end, push);
            sum_.value += 0.25 * ((region.corner(f, 0) - apex.point).dot(push.force) - apex.shift.dot(push.of_end));
            if (origin != pushed_) continue;
            sum_.force -= sense_ * push.force;
            sum_.moment -= sense_ * push.moment;
        }
    }

    /// The place in the list.
    std::size_t nearest(const Vec3& x, std::span<const std::size_t> list) const {
        std::size_t best = 0;
        double least = faces_[list[0]].depth(x);
        for (std::size_t i = 1; i < list.size(); ++i) { // without branches: the processor would guess wrong
            const double depth = faces_[list[i]].depth(x);
            best = depth < least ? i : best;
            least = depth < least ? depth : least;
        }
        return best;
    }

    /// Adds the polygon in a loop: whole where one face of the list is the nearest to all its corners, else its parts.
    void add_parts(std::size_t place, List near, std::size_t level, std::size_t apart, Push& push) {
        const std::vector<Vec3>& polygon = work_.loops[place];
        if (polygon.size() < 3) return;
        const auto add_whole = [&](std::size_t face) { add_polygon(polygon, faces_[face], face == apart, push); };
        if (near.size() == 1) return add_whole(near[0]);
        Vec3 middle = Vec3::Zero();
        for (const Vec3& x : polygon) middle += x;
        const std::size_t one = nearest(middle / static_cast<double>(polygon.size()), near);
        std::size_t two = one;
        for (std::size_t i = 0; i < polygon.size() && two == one; ++i) two = nearest(polygon[i], near);
        if (two == one) return add_whole(near[one]);
        const std::size_t below = 2 * level + 1, above = below + 1;
        split(place, faces_[near[one]], faces_[near[two]], below, above);
        add_parts(below, without(near, two), level + 1, apart, push);
        add_parts(above, without(near, one), level + 1, apart, push);
    }

    /// Divides a polygon into the part that is nearer to the first of two faces, and that nearer to the second.
    void split(std::size_t place, const HalfSpace& one, const HalfSpace& two, std::size_t to_one, std::size_t to_two) {
        std::vector<Vec3>&below = work_.loops[to_one], &above = work_.loops[to_two];
        const std::vector<Vec3>& polygon = work_.loops[place];
        const HalfSpace between{two.normal - one.normal, two.reach - one.reach};
        // Each corner and each of the two cuts, twice at most.
        below.resize(2 * polygon.size());
        above.resize(2 * polygon.size());
        Vec3 *to_below = below.data(), *to_above = above.data();
        const Vec3* x = &polygon.back();
        double depth = between.depth(*x);
        for (const Vec3& next : polygon) {
            const double next_depth = between.depth(next);
            if ((depth < 0) != (next_depth < 0))
                *to_below++ = *to_above++ = *x + depth / (depth - next_depth) * (next - *x);
            *(next_depth < 0 ? to_above : to_below)++ = next;
            x = &next;
            depth = next_depth;
        }
        below.resize(static_cast<std::size_t>(to_below - below.data()));
        above.resize(static_cast<std::size_t>(to_above - above.data()));
    }

    const std::vector<HalfSpace>& faces_;
    FaceOrigin own_, pushed_;
    double sense_, deepest_;
    DepthScratch& work_;
    OverlapGradient sum_;
};

/// Whether a list of faces holds one in the same plane: two triangles of a plane count once.
bool holds_plane_of(const std::vector<HalfSpace>& faces, const std::vector<std::size_t>& list, std::size_t face) {
    return std::any_of(list.begin(), list.end(), [&](std::size_t i) {
        return faces[i].reach == faces[face].reach && faces[i].normal == faces[face].normal;
    });
}

} // namespace

OverlapGradient depth_gradient(const ConvexClip& part, const std::vector<HalfSpace>& faces, bool of_subject,
                               bool second, DepthScratch& scratch) {
    // The faces that may be the nearest somewhere. No place is deeper than the deepest corner below any one face.
    std::vector<double>& least = scratch.least;
    least.clear();
    double deepest = std::numeric_limits<double>::infinity();
    for (const HalfSpace& face : faces) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        part.each_vertex([&](const Vec3& x) {
            const double depth = face.depth(x);
            low = std::min(low, depth);
            high = std::max(high, depth);
        });
        least.push_back(low);
        deepest = std::min(deepest, high);
    }
    scratch.near.clear();
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (least[i] <= deepest && !holds_plane_of(faces, scratch.near, i)) scratch.near.push_back(i);
    const std::size_t count = scratch.near.size();
    // The surface of the second body is pushed, or that of the first pushes it.
    DepthIntegral integral(faces, of_subject ? FaceOrigin::subject : FaceOrigin::clipper, of_subject == second ? -1 : 1,
                           deepest, scratch);
    const std::span<std::size_t> near = std::span(scratch.near).first(count);
    integral.add(part, near, 0);
    return integral.sum();
}

} // namespace kaya
