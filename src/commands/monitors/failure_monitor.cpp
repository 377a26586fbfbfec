#include "commands/monitors/failure_monitor.hpp"

#include "mechanics/cycle/cycle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace kaya {

namespace {

/// Least cosine between the displacements of two thirds of a straight path.
constexpr double straight = 0.98;
/// Part of the speed and the kinetic energy of a window's first third that the last one has, or more.
constexpr double kept = 0.98;
/// The force out of balance falls where it loses more than this part of its mean in a window, and the slope is so many times its standard error.
constexpr double noticed = 1e-6, sure = 2;
/// The decrease has ended where it is less than this part of the previous one, and this part of the value will remain.
constexpr double slowing = 0.9, remaining = 0.5;
/// Part of the observed bodies that must move in this way.
constexpr double most = 0.9;
/// One of this many bodies is observed, the fastest ones.
constexpr std::size_t share = 100;
/// Part of the work done on the model that may be stored.
constexpr double stored_part = 0.1;

bool may_move(unsigned fixed) { return (fixed & 7) != 7; }

std::vector<Vec3> places_of(const Model& model) {
    std::vector<Vec3> places;
    const auto& blocks = model.blocks;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (!blocks.deformable[b] && may_move(blocks.fixed[b])) places.push_back(blocks.displacement[b]);
    const auto& points = model.gridpoints;
    for (std::size_t g = 0; g < points.size(); ++g)
        if (blocks.deformable[points.block[g]] && may_move(points.fixed[g])) places.push_back(points.displacement[g]);
    return places;
}

} // namespace

FailureMonitor::FailureMonitor(const Model& model, const Cycle& cycle, std::int64_t window)
    : model_(model), cycle_(cycle), stride_(std::max<std::int64_t>(1, window / static_cast<std::int64_t>(intervals))),
      until_check_(stride_) {
    samples_.push_back(now());
}

FailureMonitor::Sample FailureMonitor::now() const {
    const Energy& energy = model_.energy;
    return {kinetic_ / static_cast<double>(stride_), ratio_ / static_cast<double>(stride_), energy.supplied(),
            energy.joint_stored() + cycle_.energy_in_zones(), places_of(model_)};
}

bool FailureMonitor::sample() {
    kinetic_ += model_.energy.kinetic;
    ratio_ += model_.clock.average_ratio;
    if (--until_check_ > 0) return false;
    samples_.push_back(now());
    until_check_ = stride_, kinetic_ = 0, ratio_ = 0;
    if (samples_.size() <= intervals) return false;
    if (samples_.size() > intervals + 1) samples_.pop_front();
    return goes_on();
}

bool FailureMonitor::force_falls() const {
    // A straight line through the ratios of the window by least squares, and the standard error of its slope.
    const double n = intervals, middle = 0.5 * (n + 1), spread = n * (n * n - 1) / 12;
    double mean = 0, slope = 0, scatter = 0;
    for (std::size_t i = 1; i <= intervals; ++i) {
        mean += samples_[i].ratio / n;
        slope += (static_cast<double>(i) - middle) * samples_[i].ratio / spread;
    }
    for (std::size_t i = 1; i <= intervals; ++i) {
        const double off = samples_[i].ratio - mean - slope * (static_cast<double>(i) - middle);
        scatter += off * off;
    }
    const double error = std::sqrt(scatter / (n - 2) / spread);
    if (!(slope < -sure * error && slope * n < -noticed * mean)) return false;

    // A slowing decrease: its limit, if the decreases from third to third form a geometric series.
    std::array<double, 3> thirds{};
    for (std::size_t i = 0; i < intervals; ++i) thirds[i / third] += samples_[i + 1].ratio / third;
    const double before = thirds[0] - thirds[1], lately = thirds[1] - thirds[2];
    if (!(before > 0 && lately >= 0 && lately < slowing * before)) return true;
    return thirds[2] - lately * lately / (before - lately) < remaining * thirds[2];
}

bool FailureMonitor::goes_on() const {
    const std::size_t n = samples_.back().places.size();
    if (n == 0 || std::ranges::any_of(samples_, [&](const Sample& sample) { return sample.places.size() != n; }))
        return false;

    double early = 0, late = 0; // kinetic energies of the first and the last third
    for (std::size_t i = 1; i <= third; ++i) early += samples_[i].kinetic, late += samples_[2 * third + i].kinetic;
    if (!(late >= kept * early) || force_falls()) return false;

    const double supplied = samples_.back().supplied - samples_.front().supplied,
                 stored = samples_.back().stored - samples_.front().stored;
    if (!(supplied > 0 && stored <= stored_part * supplied)) return false;

    std::vector<double> shifts(n);
    for (std::size_t i = 0; i < n; ++i)
        shifts[i] = (samples_.back().places[i] - samples_.front().places[i]).squaredNorm();
    std::vector<std::size_t> fastest(n);
    std::iota(fastest.begin(), fastest.end(), 0);
    const std::size_t count = std::max<std::size_t>(1, n / share);
    std::ranges::nth_element(
        fastest, fastest.begin() + static_cast<std::ptrdiff_t>(count - 1),
        [&](std::size_t a, std::size_t b) { return shifts[a] > shifts[b] || (shifts[a] == shifts[b] && a < b); });
    std::size_t going = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = fastest[k];
        const Vec3 first = samples_[third].places[i] - samples_.front().places[i],
                   second = samples_[2 * third].places[i] - samples_[third].places[i],
                   last = samples_.back().places[i] - samples_[2 * third].places[i];
        const auto follows = [](const Vec3& a, const Vec3& b) {
            return a.dot(b) >= straight * a.norm() * b.norm() && b.norm() >= kept * a.norm();
        };
        going += shifts[i] > 0 && follows(first, second) && follows(second, last);
    }
    return static_cast<double>(going) >= most * static_cast<double>(count);
}

} // namespace kaya
