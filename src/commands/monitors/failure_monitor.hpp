// Detects the failure of a model that lost strength before it has moved far.
#pragma once

#include "model/tables/model.hpp"

#include <cstdint>
#include <deque>
#include <vector>

namespace kaya {

class Cycle;

/// Samples a model eighteen times in a window of cycles. It fails where, over the window,
///   kinetic energy does not decrease,
///   the unbalanced force does not tend to zero, as it does where joints gain strength by slip or a bolt takes up load,
///   the hundredth of all rigid blocks and gridpoints that moves farthest moves in one direction, at a speed that does not decrease, and
///   the work of gravity and loads is dissipated by friction, plastic flow, damping and motion: at most a tenth of it is stored.
/// docs/theory/stopping.md. The energy account must be on (Settings::energy).
class FailureMonitor {
public:
    /// `window` in cycles; the cycle must be prepared.
    FailureMonitor(const Model& model, const Cycle& cycle, std::int64_t window);

    /// Call after each cycle. Whether the model fails; always false during the first window.
    bool sample();

private:
    struct Sample {
        double kinetic, ratio;    ///< energy, and average ratio of the unbalanced force; means since the last sample
        double supplied, stored;  ///< energies
        std::vector<Vec3> places; ///< displacements of all that is free to move
    };
    Sample now() const;
    bool goes_on() const;
    bool force_falls() const;

    static constexpr std::size_t intervals = 18, third = intervals / 3;

    const Model& model_;
    const Cycle& cycle_;
    std::int64_t stride_, until_check_;
    double kinetic_ = 0, ratio_ = 0; ///< sums since the last sample
    std::deque<Sample> samples_;
};

} // namespace kaya
