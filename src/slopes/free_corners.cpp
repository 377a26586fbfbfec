#include "slopes/free_corners.hpp"

#include "base/plane_cross.hpp"
#include "base/stop_point.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <optional>
#include <vector>

namespace kaya {

namespace {

constexpr double least_gain = 1e-3; ///< of a further corner, as a part of the factor
constexpr double first_step = 0.04; ///< of a corner, as a part of the length of the surface

using Objective = std::function<double(const std::vector<double>&)>;

/// Minimises without derivatives, restarted from its end until that gains nothing more. The start may be missing from `x` only where it has
/// an answer.
double downhill(std::vector<double>& x, double factor, double step, int evaluations, const Objective& objective) {
    for (int round = 0; round < 6; ++round) {
        stop_point();
        nlopt::opt optimiser(nlopt::LN_SBPLX, static_cast<unsigned>(x.size()));
        optimiser.set_min_objective([](const std::vector<double>& to, std::vector<double>&,
                                       void* data) { return (*static_cast<const Objective*>(data))(to); },
                                    const_cast<Objective*>(&objective));
        optimiser.set_initial_step(step);
        optimiser.set_ftol_rel(1e-6);
        optimiser.set_maxeval(evaluations * static_cast<int>(x.size()));
        std::vector<double> trial = x;
        double least = factor;
        try {
            optimiser.optimize(trial, least);
        } catch (const nlopt::roundoff_limited&) { // limit of the precision of numbers
        }
        least = objective(trial);
        if (!(least < factor)) break;
        const bool enough = least > factor * (1 - 1e-4);
        factor = least;
        x = trial;
        if (enough) break;
    }
    return factor;
}

/// How a corner may move, as numbers: on the ground, along a line, freely, or not at all.
class Corners {
public:
    Corners(const SlopeColumns& columns, const SlipSurface& surface)
        : columns_(columns), points_(surface.points), near_(1e-6 * (columns.right() - columns.left())) {
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) on_joint_.push_back(follows_joint(i));
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const bool before = i > 0 && on_joint_[i - 1], after = i < on_joint_.size() && on_joint_[i];
            const bool end = i == 0 || i + 1 == points_.size();
            freedoms_.push_back((before && after) || (end && (before || after)) ? Freedom::held
                                : end                                           ? Freedom::ground
                                : before || after                               ? Freedom::line
                                                                                : Freedom::free);
        }
    }

    bool follows_joint_after(std::size_t corner) const { return on_joint_[corner]; }

    std::vector<double> numbers() const {
        std::vector<double> x;
        for (std::size_t i = 0; i < points_.size(); ++i) add_numbers(i, x);
        return x;
    }

    std::optional<SlipSurface> surface(const std::vector<double>& x) const {
        SlipSurface moved;
        std::size_t next = 0;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const auto point = place(i, x, next);
            if (!point) return std::nullopt;
            if (i > 0 && !(point->x() - moved.points.back().x() > near_)) return std::nullopt;
            moved.points.push_back(*point);
        }
        const double least = -1e-9 * std::pow(points_.back().x() - points_.front().x(), 2);
        for (std::size_t k = 1; k + 1 < moved.points.size(); ++k)
            if (cross(moved.points[k] - moved.points[k - 1], moved.points[k + 1] - moved.points[k]) < least)
                return std::nullopt;
        return moved;
    }

private:
    enum class Freedom { held, ground, line, free };

    bool follows_joint(std::size_t i) const {
        const SectionPoint middle = 0.5 * (points_[i] + points_[i + 1]), along = points_[i + 1] - points_[i];
        return columns_.strength_at(middle, along) != columns_.strength_at(middle, SectionPoint::Zero());
    }

    /// The direction of the joint on one side of a corner.
    SectionPoint line_at(std::size_t i) const {
        const std::size_t from = i > 0 && on_joint_[i - 1] ? i - 1 : i;
        return (points_[from + 1] - points_[from]).normalized();
    }

    void add_numbers(std::size_t i, std::vector<double>& x) const {
        switch (freedoms_[i]) {
        case Freedom::held: break;
        case Freedom::ground: x.push_back(points_[i].x()); break;
        case Freedom::line: x.push_back(0); break;
        case Freedom::free: x.insert(x.end(), {points_[i].x(), points_[i].y()}); break;
        }
    }

    std::optional<SectionPoint> place(std::size_t i, const std::vector<double>& x, std::size_t& next) const {
        switch (freedoms_[i]) {
        case Freedom::held: break;
        case Freedom::ground: {
            const double at = x[next++];
            const auto height = columns_.ground_at(at, i == 0 ? SlopeColumns::Side::right : SlopeColumns::Side::left);
            return height ? std::optional(SectionPoint(at, *height)) : std::nullopt;
        }
        case Freedom::line: return points_[i] + x[next++] * line_at(i);
        case Freedom::free: {
            const SectionPoint point(x[next], x[next + 1]);
            next += 2;
            return point.y() >= columns_.lowest() ? std::optional(point) : std::nullopt;
        }
        }
        return points_[i];
    }

    const SlopeColumns& columns_;
    std::vector<SectionPoint> points_;
    std::vector<char> on_joint_; ///< between a corner and the next one
    std::vector<Freedom> freedoms_;
    double near_;
};

/// All corners move.
RatedSurface moved(const SlopeColumns& columns, const RatedSurface& from, const SurfaceRating& rating) {
    const Corners corners(columns, from.surface);
    const Objective objective = [&](const std::vector<double>& x) {
        const auto surface = corners.surface(x);
        return surface ? rating.factor(*surface) : rating.no_answer;
    };
    std::vector<double> x = corners.numbers();
    if (x.empty()) return from;
    const double length = from.surface.points.back().x() - from.surface.points.front().x();
    const double factor = downhill(x, from.factor, first_step * length, 200, objective);
    return factor < from.factor ? RatedSurface{factor, *corners.surface(x)} : from;
}

/// One more corner, which moves alone, in the part where it gains most.
RatedSurface with_one_more(const SlopeColumns& columns, const RatedSurface& from, const SurfaceRating& rating) {
    RatedSurface best = from;
    const Corners corners(columns, from.surface);
    for (std::size_t i = 0; i + 1 < from.surface.points.size(); ++i) {
        if (corners.follows_joint_after(i)) continue;
        SlipSurface trial = from.surface;
        const SectionPoint a = trial.points[i], b = trial.points[i + 1];
        trial.points.insert(trial.points.begin() + static_cast<std::ptrdiff_t>(i + 1), 0.5 * (a + b));
        const Objective objective = [&](const std::vector<double>& x) {
            // Below its part, by a share of the part's width and depth: it bends upward there.
            const double part = x[0];
            if (!(part > 0.02 && part < 0.98) || x[1] < 0) return rating.no_answer;
            trial.points[i + 1] = a + part * (b - a) - SectionPoint(0, x[1]);
            for (const std::size_t k : {i, i + 2}) {
                if (k == 0 || k + 1 >= trial.points.size()) continue;
                if (cross(trial.points[k] - trial.points[k - 1], trial.points[k + 1] - trial.points[k]) < 0)
                    return rating.no_answer;
            }
            return trial.points[i + 1].y() < columns.lowest() ? rating.no_answer : rating.factor(trial);
        };
        std::vector<double> x{0.5, 0.02 * (b - a).norm()};
        const double start = objective(x);
        const double factor = downhill(x, start, 0.05 * (b - a).norm(), 40, objective);
        if (!(factor < best.factor)) continue;
        objective(x);
        best = {factor, trial};
    }
    return best;
}

} // namespace

RatedSurface with_free_corners(const SlopeColumns& columns, RatedSurface from, std::size_t corners,
                               const SurfaceRating& rating) {
    from = moved(columns, from, rating);
    while (from.surface.points.size() < corners) {
        RatedSurface next = with_one_more(columns, from, rating);
        if (!(next.factor < from.factor)) break;
        next = moved(columns, next, rating);
        const bool enough = next.factor > (1 - least_gain) * from.factor;
        from = std::move(next);
        if (enough) break;
    }
    return from;
}

} // namespace kaya
