// SPDX-License-Identifier: MIT
// A root between two places, for laws that are known in one direction only.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

namespace kaya::joints {

/// `found` is false when the function has the same sign at both ends, or is not finite there; x is then the end with the smaller value.
struct Root {
    double x;
    bool found;
};

/// Where f, which is continuous, is 0 between a and b, to within `tolerance` or, with 0, to the last bit but a few; at a jump
/// the place of the jump. Chandrupatla 1997, Adv. Eng. Software 28: inverse quadratic steps where they are safe, halves
/// elsewhere; never more than some hundred calls, usually ten. The same numbers give the same bits on every machine.
template <class Function> Root bracketed_root(Function f, double a, double b, double tolerance = 0) {
    double at_a = f(a), at_b = f(b);
    if (at_a == 0) return {a, true};
    if (at_b == 0) return {b, true};
    if (!(at_a < 0 ? at_b > 0 : at_a > 0 && at_b < 0)) return {std::abs(at_b) < std::abs(at_a) ? b : a, false};
    double c = a, at_c = at_a, part = 0.5;
    constexpr int most = 200;
    for (int step = 0; step < most; ++step) {
        const double x = a + part * (b - a), at_x = f(x);
        // a is the newest place, b the one across the root, c the one before.
        if (std::signbit(at_x) == std::signbit(at_a)) {
            c = a, at_c = at_a;
        } else {
            c = b, at_c = at_b;
            b = a, at_b = at_a;
        }
        a = x, at_a = at_x;
        const bool a_is_best = std::abs(at_a) < std::abs(at_b);
        const double best = a_is_best ? a : b;
        if ((a_is_best ? at_a : at_b) == 0) return {best, true};
        constexpr double few_bits = 2 * std::numeric_limits<double>::epsilon();
        const double near = few_bits * std::abs(best) + 0.5 * tolerance, width = std::abs(b - a);
        if (near >= 0.5 * width) return {best, true};
        // Whether the inverse parabola through the three points stays between them.
        const double along = (a - b) / (c - b), rise = (at_a - at_b) / (at_c - at_b);
        part = 0.5;
        if (1 - std::sqrt(1 - along) < rise && rise < std::sqrt(along))
            part = at_a / (at_b - at_a) * at_c / (at_b - at_c) +
                   (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b);
        const double least = near / width;
        part = std::fmin(std::fmax(part, least), 1 - least);
    }
    return {std::abs(at_a) < std::abs(at_b) ? a : b, true};
}

} // namespace kaya::joints
