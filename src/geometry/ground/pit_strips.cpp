#include "geometry/ground/pit_strips.hpp"

#include "base/diagnostic.hpp"
#include "base/plane_cross.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace kaya {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Parts = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
                                                   CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Plan = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Parts, CGAL::Exact_intersections_tag>;

constexpr double rounding = 1e-9;  ///< of coordinates in a strip, as a part of the pit
constexpr double near_part = 1e-7; ///< corners nearer than this part of the pit are one

/// Corners of all strips; those of neighbours on their common line are merged.
class Corners {
public:
    explicit Corners(double near) : near_(near) {}

    int add(const Vec3& point) {
        const auto cell = [&](double v) { return static_cast<long long>(std::floor(v / near_)); };
        const long long i = cell(point.x()), j = cell(point.y());
        for (long long a = i - 1; a <= i + 1; ++a)
            for (long long b = j - 1; b <= j + 1; ++b)
                if (const auto found = rows_.find({a, b}); found != rows_.end())
                    if ((points[static_cast<std::size_t>(found->second)] - point).head<2>().norm() < near_)
                        return found->second;
        rows_[{i, j}] = static_cast<int>(points.size());
        points.push_back(point);
        return static_cast<int>(points.size()) - 1;
    }

    std::vector<Vec3> points;

private:
    double near_;
    std::map<std::pair<long long, long long>, int> rows_;
};

/// Lines of one strip where its wall bends, in distances along the edge and inward from it.
class StripMesh {
public:
    StripMesh(const PitStrip& strip, const PitProfile& profile, double size)
        : strip_(strip), profile_(profile), round_(rounding * size) {
        for (const SectionVector& corner : strip.corners) {
            const SectionVector arm = corner - strip.from;
            outline_.push_back(rounded(arm.dot(strip.along), cross(strip.along, arm)));
            low_ = std::min(low_, CGAL::to_double(outline_.vertex(outline_.size() - 1).x()));
            high_ = std::max(high_, CGAL::to_double(outline_.vertex(outline_.size() - 1).x()));
        }
        if (!outline_.is_simple())
            throw Diagnostic(fmt::format("a wall of the pit is too narrow beside the pit, which is {:.6g} long", size),
                             "look for a corner of the outline that is far from the others");
        for (std::size_t i = 0; i < outline_.size(); ++i)
            plan_.insert_constraint(outline_.vertex(i), outline_.vertex((i + 1) % outline_.size()));
        for (const double knot : profile.knots()) line(low_, knot, high_, knot);
        for (const RampPart& part : strip.ramp) add(part);
    }

    void triangles(Corners& corners, std::vector<std::array<int, 3>>& all) const {
        for (const auto face : plan_.finite_face_handles()) {
            if (outline_.bounded_side(CGAL::centroid(plan_.triangle(face))) != CGAL::ON_BOUNDED_SIDE) continue;
            std::array<int, 3> triangle;
            for (int k = 0; k < 3; ++k)
                triangle[static_cast<std::size_t>(k)] = corners.add(placed(face->vertex(k)->point()));
            // Corners that are one have no triangle between them.
            if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
                all.push_back(triangle);
        }
    }

private:
    Kernel::Point_2 rounded(double s, double d) const {
        return {std::round(s / round_) * round_, std::round(d / round_) * round_};
    }

    void line(double s1, double d1, double s2, double d2) {
        if (const auto a = rounded(s1, d1), b = rounded(s2, d2); a != b) plan_.insert_constraint(a, b);
    }

    void add(const RampPart& part) {
        const double from = std::max(part.from, low_), to = std::min(part.to, high_);
        if (!(to > from)) return;
        const auto at = [&](const std::array<double, 2>& ends, double s) {
            return ends[0] + (ends[1] - ends[0]) * (s - part.from) / (part.to - part.from);
        };
        const std::array<double, 2> s{from, to}, height{at(part.height, from), at(part.height, to)},
            shift{at(part.shift, from), at(part.shift, to)};
        for (const double knot : profile_.knots()) line(s[0], knot + shift[0], s[1], knot + shift[1]);
        // The outer and the inner edge of the ramp: on one face all along, or at the sides of one berm.
        const double middle = 0.5 * (height[0] + height[1]);
        const std::array<double, 2> outer{outer_edge(height[0], middle), outer_edge(height[1], middle)};
        line(s[0], outer[0], s[1], outer[1]);
        line(s[0], outer[0] + shift[0], s[1], outer[1] + shift[1]);
        // Where the ramp gets wider the whole wall below it bends.
        const double inner = shift[0] != shift[1] ? profile_.width() : -1;
        for (std::size_t e = 0; e < 2; ++e)
            line(s[e], 0, s[e], std::max(inner, profile_.last_at(height[e])) + std::max(shift[0], shift[1]));
    }

    /// Where the wall reaches a height at one end of a part whose middle is at another height: on the same face.
    double outer_edge(double height, double middle) const {
        return height > middle ? profile_.last_at(height) : profile_.first_at(height);
    }

    Vec3 placed(const Kernel::Point_2& point) const {
        const double s = CGAL::to_double(point.x()), d = CGAL::to_double(point.y());
        const SectionVector place =
            strip_.from + s * strip_.along + d * SectionVector(-strip_.along.y(), strip_.along.x());
        return {place.x(), place.y(), height(s, d)};
    }

    double height(double s, double d) const {
        for (const RampPart& part : strip_.ramp) {
            if (s < part.from || s > part.to) continue;
            const double share = (s - part.from) / (part.to - part.from);
            return profile_.height(d, part.height[0] + (part.height[1] - part.height[0]) * share,
                                   part.shift[0] + (part.shift[1] - part.shift[0]) * share);
        }
        return profile_.height(d);
    }

    const PitStrip& strip_;
    const PitProfile& profile_;
    double round_, low_ = INFINITY, high_ = -INFINITY;
    CGAL::Polygon_2<Kernel> outline_;
    Plan plan_;
};

} // namespace

PitMesh mesh_of(const std::vector<PitStrip>& strips, const PitProfile& profile) {
    double size = 0;
    for (const PitStrip& strip : strips) size = std::max(size, (strip.from - strips.front().from).norm());
    Corners corners(near_part * size);
    PitMesh mesh;
    for (const PitStrip& strip : strips) StripMesh(strip, profile, size).triangles(corners, mesh.triangles);
    mesh.corners = std::move(corners.points);
    return mesh;
}

} // namespace kaya
