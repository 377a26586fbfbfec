// The closure at which an overlap carries a force.
#pragma once

namespace kaya {

/// `missing` returns the force missing at a closure and decreases with it; the search finds its zero, starting at `start` with the step
/// `reach`, which doubles.
template <class Missing> double closure_with_none_missing(const Missing& missing, double start, double reach) {
    constexpr int doublings = 60, halvings = 60;
    double low = start, high = start;
    for (int i = 0; i < doublings && missing(high) > 0; ++i) high = start + reach * static_cast<double>(1ll << i);
    for (int i = 0; i < doublings && missing(low) < 0; ++i) low = start - reach * static_cast<double>(1ll << i);
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (missing(middle) > 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace kaya
