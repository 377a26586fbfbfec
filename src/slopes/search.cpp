#include "slopes/search.hpp"

#include "slopes/joint_surfaces.hpp"

#include "base/stop_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <vector>

namespace kaya {

namespace {

constexpr double no_answer = 1e6; ///< a factor that no surface has
/// Methods differ by some percent on one circle (Fredlund and Krahn 1977).
constexpr double most_beyond_bishop = 1.05;
constexpr int most_even_corners = 8;        ///< of the first polylines; further corners are added where they gain most
constexpr std::size_t kept_for_corners = 3; ///< polylines whose corners are moved freely

struct Ends {
    std::array<double, 2> left, right;
};

class Search {
public:
    Search(const SlopeColumns& columns, const SurfaceSearch& search) : columns_(columns), search_(search) {
        const double width = columns.right() - columns.left();
        double low = INFINITY, high = -INFINITY;
        for (const SectionPoint& point : columns.ground())
            low = std::min(low, point.y()), high = std::max(high, point.y());
        size_ = high - low > 1e-3 * width ? high - low : width;
        least_depth_ = std::max(search.least_depth, 1e-3 * size_);
    }

    /// Left and right ends, for a body that slides to the right or to the left.
    std::vector<Ends> both_ends() const {
        const std::array<double, 2> all{columns_.left(), columns_.right()};
        const auto entry = search_.entry.value_or(all), exit = search_.exit.value_or(all);
        const auto sorted = [](std::array<double, 2> pair) {
            return std::array{std::min(pair[0], pair[1]), std::max(pair[0], pair[1])};
        };
        return {{sorted(entry), sorted(exit)}, {sorted(exit), sorted(entry)}};
    }
    /// A circle through two places of the ground may cut off more beyond them.
    bool slides(const SlipSurface& surface, bool right) const {
        if (!search_.entry && !search_.exit) return true;
        return (surface.points.front().y() > surface.points.back().y()) == right && ends_as_asked(surface, right);
    }

    /// Whether its ends and its depth satisfy the search's conditions.
    bool allows(const SlipSurface& surface, bool right) const {
        return ends_as_asked(surface, right) && depth_of(surface) >= least_depth_;
    }

    double factor(const SlipSurface& surface, SliceMethod method) const {
        const auto body = body_above(columns_, surface, search_.slices);
        if (!body) return no_answer;
        const auto answer = factor_of_safety(*body, method);
        // Slices that push each other up are not a sliding body.
        return answer && answer->lambda >= 0 ? answer->factor : no_answer;
    }

    /// By its ends and the depth of its middle below the chord, as a part of the chord.
    std::optional<SlipSurface> circle(double left, double right, double sag) const {
        if (!(right - left > 1e-3 * size_)) return std::nullopt;
        const auto z_left = columns_.ground_at(left), z_right = columns_.ground_at(right, SlopeColumns::Side::left);
        if (!z_left || !z_right || !(sag > 1e-4)) return std::nullopt;
        const SectionPoint a(left, *z_left), b(right, *z_right), chord = b - a;
        const double length = chord.norm(), depth = sag * length,
                     radius = (0.25 * length * length + depth * depth) / (2 * depth);
        const SectionPoint normal(-chord.y() / length, chord.x() / length); // upward
        const SectionPoint centre = 0.5 * (a + b) + (radius - depth) * normal;
        // The lower half of the circle only: a surface has one height at each distance.
        if (centre.y() < std::max(a.y(), b.y())) return std::nullopt;
        auto surface = circle_surface(columns_, centre, radius);
        if (!surface || depth_of(*surface) < least_depth_) return std::nullopt;
        return surface;
    }

    /// From its ends and the depths of the corners below the chord, divided by the chord's horizontal length.
    std::optional<SlipSurface> polyline(const std::vector<double>& x) const {
        const double left = x[0], right = x[1];
        if (!(right - left > 1e-3 * size_)) return std::nullopt;
        const auto z_left = columns_.ground_at(left), z_right = columns_.ground_at(right, SlopeColumns::Side::left);
        if (!z_left || !z_right) return std::nullopt;
        SlipSurface surface;
        const std::size_t inner = x.size() - 2;
        for (std::size_t k = 0; k < inner + 2; ++k) {
            const double part = static_cast<double>(k) / static_cast<double>(inner + 1);
            const double depth = k == 0 || k == inner + 1 ? 0 : x[k + 1] * (right - left);
            surface.points.emplace_back(left + part * (right - left), *z_left + part * (*z_right - *z_left) - depth);
            if (surface.points.back().y() < columns_.lowest()) return std::nullopt;
        }
        // A body could not move over a corner that points upward.
        for (std::size_t k = 1; k + 1 < surface.points.size(); ++k) {
            const SectionPoint before = surface.points[k] - surface.points[k - 1],
                               after = surface.points[k + 1] - surface.points[k];
            if (before.x() * after.y() - before.y() * after.x() < -1e-9 * size_ * size_) return std::nullopt;
        }
        if (depth_of(surface) < least_depth_) return std::nullopt;
        return surface;
    }

    double depth_of(const SlipSurface& surface) const {
        double depth = 0;
        for (const SectionPoint& point : surface.points)
            depth = std::max(depth, columns_.ground_at(point.x()).value_or(-INFINITY) - point.y());
        return depth;
    }

    const SlopeColumns& columns() const { return columns_; }
    const SurfaceSearch& asked() const { return search_; }
    double size() const { return size_; }

private:
    const SlopeColumns& columns_;
    const SurfaceSearch& search_;
    double size_ = 1, least_depth_ = 0;

    bool ends_as_asked(const SlipSurface& surface, bool right) const {
        constexpr double rounding = 1e-9; // of the section
        const Ends ends = both_ends()[right ? 0 : 1];
        const double near = rounding * (columns_.right() - columns_.left());
        const auto within = [&](double x, const std::array<double, 2>& limits) {
            return x >= limits[0] - near && x <= limits[1] + near;
        };
        return within(surface.points.front().x(), ends.left) && within(surface.points.back().x(), ends.right);
    }
};

struct Candidate {
    double factor;
    std::vector<double> x;
    bool right;
};

constexpr int net_steps = 28, net_sags = 14;       ///< of the net of circles
constexpr double least_sag = 0.02, sag_range = 25; ///< in fractions of the chord, up to half of it

/// Finer nets around a circle, which follow the weakest one. Minimisation along single directions stops where a circle is tangent to a weak
/// layer or to the bottom of the section, though the factor still falls along it.
Candidate with_finer_nets(const Search& search, Candidate best, SliceMethod method) {
    constexpr int side = 3, rounds = 12;
    const Ends ends = search.both_ends()[best.right ? 0 : 1];
    std::array<double, 3> reach{(ends.left[1] - ends.left[0]) / net_steps, (ends.right[1] - ends.right[0]) / net_steps,
                                std::pow(sag_range, 1.0 / (net_sags - 1))};
    for (int round = 0; round < rounds; ++round) {
        const std::vector<double> centre = best.x;
        bool inside = true;
        for (int i = -side; i <= side; ++i) {
            stop_point();
            for (int j = -side; j <= side; ++j)
                for (int k = -side; k <= side; ++k) {
                    const std::vector<double> x{
                        std::clamp(centre[0] + reach[0] * i / side, ends.left[0], ends.left[1]),
                        std::clamp(centre[1] + reach[1] * j / side, ends.right[0], ends.right[1]),
                        std::min(0.5, centre[2] * std::pow(reach[2], static_cast<double>(k) / side))};
                    const auto surface = search.circle(x[0], x[1], x[2]);
                    if (!surface || !search.slides(*surface, best.right)) continue;
                    const double factor = search.factor(*surface, method);
                    if (!(factor < best.factor)) continue;
                    best.factor = factor, best.x = x;
                    inside = std::max({std::abs(i), std::abs(j), std::abs(k)}) < side;
                }
        }
        if (inside) reach = {0.4 * reach[0], 0.4 * reach[1], std::pow(reach[2], 0.4)};
    }
    return best;
}

/// The weakest circles of a net, none too near to a better one.
std::vector<Candidate> circle_net(const Search& search, SliceMethod method) {
    constexpr int kept = 6;
    std::vector<Candidate> all;
    bool right = true;
    for (const Ends& ends : search.both_ends()) {
        for (int i = 0; i <= net_steps; ++i) {
            stop_point();
            for (int j = 0; j <= net_steps; ++j)
                for (int k = 0; k < net_sags; ++k) {
                    std::vector<double> x{ends.left[0] + (ends.left[1] - ends.left[0]) * i / net_steps,
                                          ends.right[0] + (ends.right[1] - ends.right[0]) * j / net_steps,
                                          least_sag * std::pow(sag_range, static_cast<double>(k) / (net_sags - 1))};
                    const auto surface = search.circle(x[0], x[1], x[2]);
                    if (!surface || !search.slides(*surface, right)) continue;
                    const double factor = search.factor(*surface, method);
                    if (factor < no_answer) all.push_back({factor, std::move(x), right});
                }
        }
        right = !right;
        if (!search.asked().entry && !search.asked().exit) break; // one direction covers all surfaces
    }
    std::ranges::stable_sort(all, {}, &Candidate::factor);
    std::vector<Candidate> best;
    for (auto& candidate : all) {
        const bool near = std::ranges::any_of(best, [&](const Candidate& other) {
            return std::abs(other.x[0] - candidate.x[0]) + std::abs(other.x[1] - candidate.x[1]) < 0.25 * search.size();
        });
        if (near) continue;
        best.push_back(std::move(candidate));
        if (best.size() == kept) break;
    }
    return best;
}

using Objective = std::function<double(const std::vector<double>&)>;

/// Where a search of NLopt from a place, between limits, ends.
Candidate searched(nlopt::opt optimiser, Candidate from, const std::vector<double>& low,
                   const std::vector<double>& high, const Objective& objective) {
    optimiser.set_min_objective([](const std::vector<double>& x, std::vector<double>&,
                                   void* data) { return (*static_cast<const Objective*>(data))(x); },
                                const_cast<Objective*>(&objective));
    optimiser.set_lower_bounds(low);
    optimiser.set_upper_bounds(high);
    for (std::size_t i = 0; i < from.x.size(); ++i) from.x[i] = std::clamp(from.x[i], low[i], high[i]);
    try {
        optimiser.optimize(from.x, from.factor);
    } catch (const nlopt::roundoff_limited&) { // limit of the precision of numbers
    }
    from.factor = objective(from.x);
    return from;
}

/// Minimises without derivatives, restarted from its end until that gains nothing more.
Candidate downhill(Candidate from, const std::vector<double>& steps, const std::vector<double>& low,
                   const std::vector<double>& high, const Objective& objective) {
    for (int round = 0; round < 4; ++round) {
        const double before = from.factor;
        nlopt::opt optimiser(nlopt::LN_SBPLX, static_cast<unsigned>(from.x.size()));
        optimiser.set_initial_step(steps);
        optimiser.set_ftol_rel(1e-7);
        optimiser.set_maxeval(static_cast<int>(200 * from.x.size()));
        const Candidate end = searched(optimiser, from, low, high, objective);
        if (end.factor < from.factor) from = end;
        if (from.factor > before * (1 - 1e-5)) break;
    }
    return from;
}

std::optional<FoundSurface> found(const Search& search, const std::optional<SlipSurface>& surface, SliceMethod method) {
    if (!surface) return std::nullopt;
    const auto body = body_above(search.columns(), *surface, search.asked().slices);
    if (!body) return std::nullopt;
    const auto answer = factor_of_safety(*body, method);
    if (!answer) return std::nullopt;
    return FoundSurface{*surface, *answer};
}

std::optional<Candidate> best_circle(const Search& search, std::vector<Candidate>* all = nullptr) {
    std::optional<Candidate> best;
    constexpr std::size_t refined = 3;
    auto starts = circle_net(search, SliceMethod::bishop);
    const std::size_t of_net = starts.size();
    for (std::size_t i = 0; i < std::min(refined, of_net); ++i)
        starts.push_back(with_finer_nets(search, starts[i], SliceMethod::bishop));
    for (const Candidate& start : starts) {
        stop_point();
        const auto both_ends = search.both_ends();
        const Ends& ends = both_ends[start.right ? 0 : 1];
        const Objective objective = [&](const std::vector<double>& x) {
            const auto surface = search.circle(x[0], x[1], x[2]);
            return surface && search.slides(*surface, start.right) ? search.factor(*surface, search.asked().method)
                                                                   : no_answer;
        };
        Candidate from = start;
        from.factor = objective(from.x);
        from = downhill(from, {0.1 * search.size(), 0.1 * search.size(), 0.2 * from.x[2]},
                        {ends.left[0], ends.right[0], 1e-3}, {ends.left[1], ends.right[1], 0.5}, objective);
        if (from.factor >= no_answer) continue;
        if (all != nullptr) all->push_back(from);
        if (!best || from.factor < best->factor) best = from;
    }
    // Where a method has no answer on the weakest circles, its weakest answer on other circles is meaningless.
    if (best && best->factor > most_beyond_bishop * starts.front().factor) best.reset();
    return best;
}

/// The factor of a polyline with its inner corners at even distances.
double factor_of(const Search& search, const std::vector<double>& x, bool right) {
    const auto surface = search.polyline(x);
    return surface && search.slides(*surface, right) ? search.factor(*surface, search.asked().method) : no_answer;
}

/// A polyline with its inner corners at even distances, on a circle.
Candidate on_circle(const Search& search, const SlipSurface& surface, std::size_t inner, bool right) {
    const SectionPoint a = surface.points.front(), b = surface.points.back(), centre = surface.circle->centre;
    Candidate start{no_answer, {a.x(), b.x()}, right};
    for (std::size_t k = 1; k <= inner; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(inner + 1),
                     at = a.x() + part * (b.x() - a.x()), d = at - centre.x();
        const double z = centre.y() - std::sqrt(std::max(0.0, surface.circle->radius * surface.circle->radius - d * d));
        start.x.push_back((a.y() + part * (b.y() - a.y()) - z) / (b.x() - a.x()));
    }
    start.factor = factor_of(search, start.x, right);
    return start;
}

/// Where a controlled random search ends: it finds weak layers, which no circle follows.
Candidate drawn(const Candidate& start, const std::vector<double>& low, std::vector<double> high,
                const Objective& objective) {
    stop_point();
    std::fill(high.begin() + 2, high.end(), 0.6);
    nlopt::opt optimiser(nlopt::GN_CRS2_LM, static_cast<unsigned>(start.x.size()));
    optimiser.set_population(static_cast<unsigned>(20 * start.x.size()));
    optimiser.set_maxeval(6000);
    optimiser.set_ftol_rel(1e-4);
    return searched(optimiser, start, low, high, objective);
}

/// Results of searches for polylines whose inner corners are at even distances.
std::vector<RatedSurface> even_polylines(const Search& search) {
    std::vector<Candidate> circles;
    if (!best_circle(search, &circles)) return {};
    const SurfaceSearch& asked = search.asked();
    const std::size_t inner = static_cast<std::size_t>(std::clamp(asked.corners, 3, most_even_corners)) - 2;
    std::vector<RatedSurface> all;
    for (const bool right : {true, false}) {
        const Ends ends = search.both_ends()[right ? 0 : 1];
        if (!right && !asked.entry && !asked.exit) break;
        const Objective objective = [&](const std::vector<double>& x) { return factor_of(search, x, right); };
        std::vector<double> low{ends.left[0], ends.right[0]}, high{ends.left[1], ends.right[1]},
            steps{0.1 * search.size(), 0.1 * search.size()};
        low.resize(inner + 2, 0.0);
        high.resize(inner + 2, 1.0);
        steps.resize(inner + 2, 0.03);
        std::vector<Candidate> starts;
        for (const Candidate& circle : circles) {
            const auto surface = search.circle(circle.x[0], circle.x[1], circle.x[2]);
            if (surface && circle.right == right) starts.push_back(on_circle(search, *surface, inner, right));
        }
        nlopt::srand(20261123);
        for (int run = 0; run < 2 && !starts.empty(); ++run)
            starts.push_back(drawn(starts.front(), low, high, objective));
        for (const Candidate& start : starts) {
            stop_point();
            if (start.factor >= no_answer) continue;
            const Candidate end = downhill(start, steps, low, high, objective);
            all.push_back({end.factor, *search.polyline(end.x)});
        }
    }
    return all;
}

} // namespace

std::optional<FoundSurface> weakest_circle(const SlopeColumns& columns, const SurfaceSearch& asked) {
    const Search search(columns, asked);
    const auto best = best_circle(search);
    if (!best) return std::nullopt;
    return found(search, search.circle(best->x[0], best->x[1], best->x[2]), asked.method);
}

std::optional<FoundSurface> weakest_polyline(const SlopeColumns& columns, const SurfaceSearch& asked) {
    SurfaceSearch by_forces = asked;
    if (needs_circle(asked.method)) by_forces.method = SliceMethod::spencer;
    const Search search(columns, by_forces);
    const SurfaceRating rating{[&](const SlipSurface& surface) {
                                   const bool right = surface.points.front().y() > surface.points.back().y();
                                   return search.allows(surface, right) ? search.factor(surface, by_forces.method)
                                                                        : no_answer;
                               },
                               no_answer};
    std::vector<RatedSurface> ends = weakest_along_joints(columns, rating);
    for (auto& end : even_polylines(search)) ends.push_back(std::move(end));
    std::ranges::stable_sort(ends, {}, &RatedSurface::factor);
    if (ends.size() > kept_for_corners) ends.resize(kept_for_corners);
    std::optional<RatedSurface> best;
    for (const RatedSurface& end : ends) {
        RatedSurface free =
            with_free_corners(columns, end, static_cast<std::size_t>(std::max(3, asked.corners)), rating);
        if (!best || free.factor < best->factor) best = std::move(free);
    }
    return best ? found(search, best->surface, by_forces.method) : std::nullopt;
}

} // namespace kaya
