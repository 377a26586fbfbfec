// Whether a model that lost strength fails, seen before it has gone far.
#pragma once

#include "model/model.hpp"

#include <cstdint>
#include <deque>
#include <vector>

namespace kaya {

class Cycle;

/// Looks at a model eighteen times in a window of cycles. It fails where, over the window,
///   kinetic energy does not fall,
///   the force out of balance does not fall toward nothing, as it does where joints gain strength by slip or a bolt takes up load,
///   the hundredth of all rigid blocks and gridpoints that goes farthest goes in one direction, at a speed that does not fall, and
///   the work of gravity and loads is lost in friction, plastic flow, damping and motion: no more than a tenth of it is stored.
/// docs/theory/stopping.md. The account of energy must be on (Settings::energy).
class FailureMonitor {
public:
    /// `window` in cycles; the cycle must be prepared.
    FailureMonitor(const Model& model, const Cycle& cycle, std::int64_t window);

    /// To be called after each cycle. Whether the model fails; looks eighteen times in a window, and does not know before the first one is over.
    bool sample();

private:
    struct Sample {
        double kinetic, ratio;    ///< energy, and average ratio of the force out of balance; means since the last look
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
    double kinetic_ = 0, ratio_ = 0; ///< sums since the last look
    std::deque<Sample> samples_;
};

} // namespace kaya
