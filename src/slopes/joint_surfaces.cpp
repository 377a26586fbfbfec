#include "slopes/joint_surfaces.hpp"

#include "base/plane_cross.hpp"
#include "base/stop_point.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <vector>

namespace kaya {

namespace {

constexpr std::size_t most_lines = 8; ///< the longest lines, which are searched
constexpr int net = 12;               ///< places of one leg that are tried first
constexpr std::size_t starts = 4,
                      kept = 4; ///< points of the net from which a descent starts, and surfaces that are returned

/// Joints, or bases of weak layers, of one line in the section, from left to right.
struct Line {
    SectionPoint from, to;
    double length() const { return (to - from).norm(); }
    bool upright() const { return !(to.x() - from.x() > 1e-6 * length()); }
    double at(double x) const { return from.y() + (to.y() - from.y()) * (x - from.x()) / (to.x() - from.x()); }
};

std::vector<Line> lines_of(const SlopeColumns& columns) {
    const double near = 1e-6 * (columns.right() - columns.left());
    std::vector<Line> lines;
    std::vector<Line> parts;
    for (const SectionJoint& joint : columns.section().joints) parts.push_back({joint.from, joint.to});
    for (const auto& base : columns.bases_of_weak_layers()) parts.push_back({base.from, base.to});
    for (Line& line : parts) {
        if (line.to.x() < line.from.x() || (line.to.x() == line.from.x() && line.to.y() < line.from.y()))
            std::swap(line.from, line.to);
        if (!(line.length() > near)) continue;
        const auto same = std::ranges::find_if(lines, [&](const Line& other) {
            const SectionPoint along = (other.to - other.from).normalized();
            return std::abs(cross(along, line.from - other.from)) < near &&
                   std::abs(cross(along, line.to - other.from)) < near;
        });
        if (same == lines.end()) {
            lines.push_back(line);
            continue;
        }
        const SectionPoint along = (same->to - same->from).normalized();
        if ((line.from - same->from).dot(along) < 0) same->from = line.from;
        if ((line.to - same->to).dot(along) > 0) same->to = line.to;
    }
    std::ranges::stable_sort(lines, std::ranges::greater(), &Line::length);
    if (lines.size() > most_lines) lines.resize(most_lines);
    return lines;
}

/// How a surface leaves its joint at one end.
struct Leg {
    enum class Kind { daylight, joint, straight };
    Kind kind = Kind::straight;
    SectionPoint
        corner = SectionPoint::Zero(),
        end = SectionPoint::
            Zero(); ///< where it leaves the line and where it reaches the ground; of a straight leg not known yet
};

class JointSearch {
public:
    JointSearch(const SlopeColumns& columns, const SurfaceRating& rating)
        : columns_(columns), rating_(rating), lines_(lines_of(columns)),
          near_(1e-6 * (columns.right() - columns.left())) {}

    std::vector<RatedSurface> weakest() {
        for (const Line& base : lines_) {
            stop_point();
            if (base.upright()) continue;
            const auto left = legs(base, false), right = legs(base, true);
            for (const Leg& a : left)
                for (const Leg& b : right) consider(base, a, b);
        }
        std::ranges::stable_sort(found_, {}, &RatedSurface::factor);
        if (found_.size() > kept) found_.resize(kept);
        return found_;
    }

private:
    std::vector<Leg> legs(const Line& base, bool right) const {
        std::vector<Leg> all{{}};
        const SectionPoint end = right ? base.to : base.from;
        const auto ground = columns_.ground_at(end.x(), right ? SlopeColumns::Side::left : SlopeColumns::Side::right);
        if (ground && std::abs(*ground - end.y()) < 1e3 * near_) all.push_back({Leg::Kind::daylight, end, end});
        for (const Line& other : lines_) {
            if (&other == &base || other.upright()) continue;
            const SectionPoint along = base.to - base.from, leg = other.to - other.from;
            const double across = cross(along, leg);
            if (std::abs(across) < 1e-9 * along.norm() * leg.norm()) continue;
            const double part = cross(other.from - base.from, leg) / across;
            if (part < -1e-6 || part > 1 + 1e-6) continue;
            const SectionPoint corner = base.from + part * along, top = right ? other.to : other.from;
            const auto height =
                columns_.ground_at(top.x(), right ? SlopeColumns::Side::left : SlopeColumns::Side::right);
            const bool onward = right ? top.x() > corner.x() + near_ : top.x() < corner.x() - near_;
            if (onward && height && std::abs(*height - top.y()) < 1e3 * near_)
                all.push_back({Leg::Kind::joint, corner, SectionPoint(top.x(), *height)});
        }
        return all;
    }

    std::optional<SlipSurface> surface(const Line& base, Leg a, Leg b, const std::vector<double>& x) const {
        std::size_t next = 0;
        // A straight leg: where it leaves the joint, and how far from there it reaches the ground.
        const auto place = [&](Leg& leg, bool right) {
            if (leg.kind != Leg::Kind::straight) return true;
            const double at = x[next++], end = at + (right ? 1 : -1) * x[next++];
            const auto ground = columns_.ground_at(end, right ? SlopeColumns::Side::left : SlopeColumns::Side::right);
            if (!ground) return false;
            leg.corner = {at, base.at(at)};
            leg.end = {end, *ground};
            return true;
        };
        if (!place(a, false) || !place(b, true) || !(b.corner.x() - a.corner.x() > near_)) return std::nullopt;
        // An upright leg would not be part of the surface, which would then end below the ground.
        const auto upright = [&](const Leg& leg) {
            return leg.kind != Leg::Kind::daylight && std::abs(leg.end.x() - leg.corner.x()) <= near_;
        };
        if (upright(a) || upright(b)) return std::nullopt;
        SlipSurface found;
        for (const SectionPoint& point : {a.end, a.corner, b.corner, b.end})
            if (found.points.empty() || point.x() - found.points.back().x() > near_) found.points.push_back(point);
        for (std::size_t k = 1; k + 1 < found.points.size(); ++k)
            if (cross(found.points[k] - found.points[k - 1], found.points[k + 1] - found.points[k]) < -near_ * near_)
                return std::nullopt;
        return found.points.size() < 2 ? std::nullopt : std::optional(found);
    }

    double value(const Line& base, const Leg& a, const Leg& b, const std::vector<double>& x) const {
        const auto trial = surface(base, a, b, x);
        return trial ? rating_.factor(*trial) : rating_.no_answer;
    }

    void keep(const Line& base, const Leg& a, const Leg& b, const std::vector<double>& x) {
        const auto end = surface(base, a, b, x);
        const double factor = end ? rating_.factor(*end) : rating_.no_answer;
        if (factor < rating_.no_answer) found_.push_back({factor, *end});
    }

    struct Place {
        double factor;
        std::vector<double> x;
    };

    /// The weakest points of a net over all free parameters, without direct neighbours of a weaker one.
    std::vector<Place> weakest_of_net(const Line& base, const Leg& a, const Leg& b, const std::vector<double>& low,
                                      const std::vector<double>& high) const {
        const int steps = low.size() == 2 ? net : net / 2;
        std::vector<int> at(low.size(), 0);
        std::vector<double> x(low.size());
        std::vector<Place> all;
        for (bool more = true; more;) {
            for (std::size_t k = 0; k < x.size(); ++k) {
                const double part = (at[k] + 0.5) / steps;
                x[k] = low[k] + (high[k] - low[k]) * (k % 2 == 0 ? part : part * part); // legs are rather short
            }
            if (const double factor = value(base, a, b, x); factor < rating_.no_answer) all.push_back({factor, x});
            more = false;
            for (std::size_t k = 0; k < at.size() && !more; ++k) {
                more = ++at[k] < steps;
                if (!more) at[k] = 0;
            }
        }
        std::ranges::stable_sort(all, {}, &Place::factor);
        std::vector<Place> best;
        for (const Place& place : all) {
            const bool adjacent = std::ranges::any_of(best, [&](const Place& other) {
                double apart = 0;
                for (std::size_t k = 0; k < x.size(); ++k)
                    apart = std::max(apart, std::abs(other.x[k] - place.x[k]) / (high[k] - low[k]));
                return apart < 1.5 / steps;
            });
            if (adjacent) continue;
            best.push_back(place);
            if (best.size() == starts) break;
        }
        return best;
    }

    /// Minimises from the weakest places of a net.
    void consider(const Line& base, const Leg& a, const Leg& b) {
        std::vector<double> low, high;
        const double width = columns_.right() - columns_.left();
        for (const Leg* leg : {&a, &b})
            if (leg->kind == Leg::Kind::straight) {
                low.insert(low.end(), {base.from.x(), 0});
                high.insert(high.end(), {base.to.x(), 0.5 * width});
            }
        if (low.empty()) {
            keep(base, a, b, {});
            return;
        }
        const Objective objective = [&](const std::vector<double>& to) { return value(base, a, b, to); };
        std::vector<double> first(low.size());
        for (std::size_t k = 0; k < first.size(); ++k)
            first[k] = 0.5 * (high[k] - low[k]) / (first.size() == 2 ? net : net / 2);
        for (Place& place : weakest_of_net(base, a, b, low, high)) {
            stop_point();
            nlopt::opt optimiser(nlopt::LN_SBPLX, static_cast<unsigned>(low.size()));
            optimiser.set_min_objective([](const std::vector<double>& to, std::vector<double>&,
                                           void* data) { return (*static_cast<const Objective*>(data))(to); },
                                        const_cast<Objective*>(&objective));
            optimiser.set_lower_bounds(low);
            optimiser.set_upper_bounds(high);
            optimiser.set_initial_step(first);
            optimiser.set_maxeval(300);
            optimiser.set_ftol_rel(1e-5);
            std::vector<double> x = place.x;
            double least = place.factor;
            try {
                optimiser.optimize(x, least);
            } catch (const nlopt::roundoff_limited&) {}
            keep(base, a, b, objective(x) <= place.factor ? x : place.x);
        }
    }

    using Objective = std::function<double(const std::vector<double>&)>;
    const SlopeColumns& columns_;
    const SurfaceRating& rating_;
    std::vector<Line> lines_;
    double near_;
    std::vector<RatedSurface> found_;
};

} // namespace

std::vector<RatedSurface> weakest_along_joints(const SlopeColumns& columns, const SurfaceRating& rating) {
    return JointSearch(columns, rating).weakest();
}

} // namespace kaya
