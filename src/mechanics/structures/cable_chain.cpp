#include "mechanics/structures/cable_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

constexpr double small_force = 1e-12; ///< over the largest force of the chain
constexpr double bits = 2e-16;
/// Stiffness given to a node that has none, relative to the stiffnesses of the chain.
constexpr double of_smallest = 1e-9, of_largest = 1e-13;
constexpr int most_steps = 100;
constexpr double enough = 1e-3; ///< the slope at the end of a step may be this part of the slope at its start
constexpr int most_halvings = 60;

} // namespace

double CableChain::elongation(std::size_t bar) const {
    const Bar& b = bars[bar];
    return b.gap + b.second_cosine * slip[bar + 1] - b.first_cosine * slip[bar];
}

double CableChain::elastic_force(std::size_t bar) const {
    return bars[bar].stiffness * elongation(bar) + bars[bar].kept;
}

double CableChain::bar_force(std::size_t bar) const {
    const Bar& b = bars[bar];
    if (b.broken) return 0;
    return std::clamp(elastic_force(bar), -b.yield_compression, b.yield_tension);
}

double CableChain::grout_force(std::size_t node) const {
    const Grout& g = grout[node];
    return std::clamp(-g.stiffness * (slip[node] - g.lost), -g.strength, g.strength);
}

double CableChain::left_over(std::size_t node) const {
    if (grout[node].anchored) return 0;
    double force = grout_force(node);
    if (node < bars.size()) force += bars[node].first_cosine * bar_force(node);
    if (node > 0) force -= bars[node - 1].second_cosine * bar_force(node - 1);
    return force;
}

/// Newton's step, by elimination in a tridiagonal matrix. Returns the power of the residual forces along it.
double CableChain::fill_step() {
    const std::size_t n = grout.size();
    diagonal_.assign(n, 0);
    adjacent_.assign(n, 0); // of row i and column i + 1
    step_.resize(n);
    double largest = 0, smallest = std::numeric_limits<double>::infinity();
    const auto see = [&](double stiffness) {
        largest = std::max(largest, stiffness);
        if (stiffness > 0) smallest = std::min(smallest, stiffness);
    };
    for (const Grout& g : grout) see(g.stiffness);
    for (const Bar& b : bars) see(b.stiffness);
    const double least = std::max(of_smallest * smallest, of_largest * largest);
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const Bar& b = bars[i];
        const double force = elastic_force(i);
        if (b.broken || force > b.yield_tension || force < -b.yield_compression) continue;
        diagonal_[i] += b.stiffness * b.first_cosine * b.first_cosine;
        diagonal_[i + 1] += b.stiffness * b.second_cosine * b.second_cosine;
        adjacent_[i] -= b.stiffness * b.first_cosine * b.second_cosine;
    }
    for (std::size_t i = 0; i < n; ++i) {
        const Grout& g = grout[i];
        if (g.stiffness * std::abs(slip[i] - g.lost) <= g.strength) diagonal_[i] += g.stiffness;
        diagonal_[i] += least;
        step_[i] = left_over(i);
    }
    for (std::size_t i = 0; i < n; ++i)
        if (grout[i].anchored) {
            diagonal_[i] = 1;
            adjacent_[i] = 0;
            if (i > 0) adjacent_[i - 1] = 0;
        }
    forces_ = step_;
    for (std::size_t i = 1; i < n; ++i) {
        const double factor = adjacent_[i - 1] / diagonal_[i - 1];
        diagonal_[i] -= factor * adjacent_[i - 1];
        step_[i] -= factor * step_[i - 1];
    }
    for (std::size_t i = n; i-- > 0;)
        step_[i] = (step_[i] - (i + 1 < n ? adjacent_[i] * step_[i + 1] : 0)) / diagonal_[i];
    double power = 0;
    for (std::size_t i = 0; i < n; ++i) power += forces_[i] * step_[i];
    return power;
}

/// A small part of the largest force, plus the rounding error of slip differences.
double CableChain::tolerance() const {
    double size = 0, rounding = 0;
    for (std::size_t i = 0; i < bars.size(); ++i) {
        size = std::max(size, std::abs(bar_force(i)));
        rounding =
            std::max(rounding, bars[i].stiffness * (std::abs(bars[i].gap) + std::abs(slip[i]) + std::abs(slip[i + 1])));
    }
    for (std::size_t i = 0; i < grout.size(); ++i) {
        size = std::max(size, std::abs(grout_force(i)));
        rounding = std::max(rounding, grout[i].stiffness * (std::abs(slip[i]) + std::abs(grout[i].lost)));
    }
    return small_force * size + bits * rounding;
}

double CableChain::solve() {
    const auto worst = [&] {
        double most = 0;
        for (std::size_t i = 0; i < grout.size(); ++i) most = std::max(most, std::abs(left_over(i)));
        return most;
    };
    double left = worst();
    for (int k = 0; k < most_steps; ++k) {
        if (left <= tolerance()) break;
        const double power = fill_step();
        before_ = slip;
        // The slope of the energy along the step decreases; its zero is the minimum.
        const auto slope_at = [&](double part) {
            for (std::size_t i = 0; i < slip.size(); ++i) slip[i] = before_[i] + part * step_[i];
            double slope = 0;
            for (std::size_t i = 0; i < slip.size(); ++i) slope += left_over(i) * step_[i];
            return slope;
        };
        if (slope_at(1) < -enough * power) {
            double low = 0, high = 1;
            for (int halved = 0; halved < most_halvings; ++halved) {
                const double middle = 0.5 * (low + high), slope = slope_at(middle);
                if (std::abs(slope) <= enough * power) break;
                (slope > 0 ? low : high) = middle;
            }
        }
        left = worst();
        if (slip == before_) break;
    }
    return left;
}

} // namespace kaya
