#include "geometry/ground/pit_profile.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {

PitProfile::PitProfile(const PitDesign& design)
    : bench_(design.bench), slope_(std::tan(design.angle * std::numbers::pi / 180)), berm_(design.berm),
      depth_(design.bench * design.benches), knots_{0} {
    for (int k = 0; k < design.benches; ++k) {
        knots_.push_back(knots_.back() + bench_ / slope_);
        if (k + 1 < design.benches && berm_ > 0) knots_.push_back(knots_.back() + berm_);
    }
}

double PitProfile::height(double distance) const {
    const double pitch = bench_ / slope_ + berm_;
    const double bench = std::floor(std::max(0.0, distance) / pitch);
    const double part = std::max(0.0, distance) - bench * pitch;
    return std::max(-depth_, -bench * bench_ - std::min(bench_, part * slope_));
}

double PitProfile::first_at(double height) const {
    const double down = std::clamp(-height, 0.0, depth_);
    // On a level of a berm the bench above it ends there.
    const double bench = std::max(0.0, std::ceil(down / bench_ - 1e-9) - 1);
    return bench * (bench_ / slope_ + berm_) + (down - bench * bench_) / slope_;
}

double PitProfile::last_at(double height) const {
    const double down = std::clamp(-height, 0.0, depth_);
    if (down >= depth_ * (1 - 1e-12)) return width();
    const double bench = std::floor(down / bench_ + 1e-9);
    return bench * (bench_ / slope_ + berm_) + std::max(0.0, down - bench * bench_) / slope_;
}

double PitProfile::height(double distance, double ramp, double shift) const {
    return std::max(height(distance), std::min(ramp, height(distance - shift)));
}

namespace {

class RampCourse {
public:
    RampCourse(const PitProfile& profile, const PitRamp& ramp, const std::vector<CrestEdge>& edges)
        : profile_(profile), ramp_(ramp), edges_(edges), parts_(edges.size()) {}

    std::vector<std::vector<RampPart>> from(std::size_t first, double at) {
        const CrestEdge& edge = edges_[first];
        const double inner = profile_.width() + ramp_.width;
        const double free_from = std::max(0.0, inner * edge.shrinks[0]),
                     free_to = edge.length - std::max(0.0, inner * edge.shrinks[1]);
        if (at < free_from || at + ramp_.width > free_to)
            throw Diagnostic(
                fmt::format("the ramp cannot begin here: the wall below needs the edge of {:.6g} from {:.6g} to {:.6g} "
                            "along it, and the ramp begins at {:.6g} and takes {:.6g} to come up to its width",
                            edge.length, free_from, free_to, at, ramp_.width),
                "let it begin on a longer edge, or farther from a corner");
        parts_[first].push_back({at, at + ramp_.width, {0, 0}, {0, ramp_.width}});
        go_down(first, at + ramp_.width);
        for (std::size_t k = 1; k < edges_.size() && height_ > -profile_.depth(); ++k) {
            const std::size_t e = (first + k) % edges_.size();
            go_down(e, room_at_corner(e, 0, height_));
        }
        if (height_ > -profile_.depth())
            throw Diagnostic(
                fmt::format("the ramp is too long for the wall: once around the pit it comes down by {:.6g} of {:.6g}",
                            -height_, profile_.depth()),
                "give it a greater gradient, or fewer benches, or a larger pit");
        return parts_;
    }

private:
    /// Level distance of the ramp from a corner, so that it has one height where two edges meet.
    double room_at_corner(std::size_t e, std::size_t end, double height) const {
        return std::max(0.0, (profile_.last_at(height) + ramp_.width) * edges_[e].shrinks[end]);
    }

    /// Level up to `start`, then down as far as the next corner lets it, and level to there.
    void go_down(std::size_t e, double start) {
        const CrestEdge& edge = edges_[e];
        const auto height_at = [&](double s) {
            return std::max(-profile_.depth(), height_ - ramp_.gradient * (s - start));
        };
        const auto has_room = [&](double s) { return s <= edge.length - room_at_corner(e, 1, height_at(s)); };
        // The farther it runs, the deeper it is, and the more the corner takes.
        double end = start, too_far = edge.length + profile_.width() + 2 * ramp_.width;
        if (has_room(start)) {
            for (int i = 0; i < 100; ++i) {
                const double middle = 0.5 * (end + too_far);
                (has_room(middle) ? end : too_far) = middle;
            }
        }
        const double floor = start + (height_ + profile_.depth()) / ramp_.gradient;
        const bool arrives = floor <= end;
        if (arrives) end = floor;
        const double far = edge.length + edge.until;
        if (parts_[e].empty()) add(e, {-far, start, {height_, height_}, {ramp_.width, ramp_.width}});
        const double after = arrives ? -profile_.depth() : height_at(end);
        if (end > start) add(e, {start, end, {height_, after}, {ramp_.width, ramp_.width}});
        if (!arrives) add(e, {end, far, {after, after}, {ramp_.width, ramp_.width}});
        height_ = after;
        const double needed = profile_.last_at(height_) + ramp_.width;
        if (needed > edge.until)
            throw Diagnostic(fmt::format("the ramp finds no wall: an edge of {:.6g} ends {:.6g} inward from the crest, "
                                         "and the ramp reaches {:.6g} inward there",
                                         edge.length, edge.until, needed),
                             "remove corners of the outline that lie close together, or let the ramp go the other way");
    }

    void add(std::size_t e, const RampPart& part) {
        // A part ends at the level of a berm: there the ramp passes from one face to the next.
        std::vector<double> ends{part.from};
        for (const double knot : profile_.knots()) {
            const double level = profile_.height(knot), drop = part.height[0] - part.height[1];
            if (!(drop > 0) || level >= part.height[0] || level <= part.height[1]) continue;
            ends.push_back(part.from + (part.to - part.from) * (part.height[0] - level) / drop);
        }
        ends.push_back(part.to);
        std::ranges::sort(ends);
        const auto height_at = [&](double s) {
            return part.height[0] + (part.height[1] - part.height[0]) * (s - part.from) / (part.to - part.from);
        };
        for (std::size_t k = 1; k < ends.size(); ++k)
            if (ends[k] - ends[k - 1] > 1e-9 * edges_[e].length)
                parts_[e].push_back({ends[k - 1], ends[k], {height_at(ends[k - 1]), height_at(ends[k])}, part.shift});
    }

    const PitProfile& profile_;
    const PitRamp& ramp_;
    const std::vector<CrestEdge>& edges_;
    std::vector<std::vector<RampPart>> parts_;
    double height_ = 0;
};

} // namespace

std::vector<std::vector<RampPart>> ramp_parts(const PitProfile& profile, const PitRamp& ramp,
                                              const std::vector<CrestEdge>& edges, std::size_t first, double at) {
    return RampCourse(profile, ramp, edges).from(first, at);
}

} // namespace kaya
