// Directions that turn with the rock in large strain; for zone models with planes.
#pragma once

#include "stdlib/zones/zone.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace kaya::zones {

/// The rotation so far, four history variables: 0 is none.
inline constexpr std::array<kaya_jhistory, 4> turn_history{{
    {"turn-real", "-", "rotation of the planes so far, a quaternion: its real part less 1"},
    {"turn-x", "-", "the same, x"},
    {"turn-y", "-", "the same, y"},
    {"turn-z", "-", "the same, z"},
}};

/// Adds the spin of the step to the rotation of row i, whose history begins at `first`, and returns a direction after it.
inline std::array<double, 3> turned(const kaya_zbatch& batch, std::size_t first, std::size_t i,
                                    const std::array<double, 3>& direction) {
    constexpr double rounding = 1e-6;
    std::array<double, 4> q;
    for (std::size_t k = 0; k < 4; ++k) q[k] = batch.history[first + k][i];
    q[0] += 1;
    const auto square = [&q] { return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]; };
    // A state of an earlier version has other numbers here.
    if (!(std::abs(square() - 1) < rounding)) q = {1, 0, 0, 0};
    std::array<double, 3> h{};
    if (batch.spin[0] != nullptr)
        for (std::size_t k = 0; k < 3; ++k) h[k] = 0.5 * batch.spin[k][i];
    if (h[0] != 0 || h[1] != 0 || h[2] != 0) {
        // (1, h) is the quaternion of (1 - W/2)^-1 (1 + W/2), but for its length.
        q = {q[0] - h[0] * q[1] - h[1] * q[2] - h[2] * q[3], q[1] + h[0] * q[0] + h[1] * q[3] - h[2] * q[2],
             q[2] + h[1] * q[0] + h[2] * q[1] - h[0] * q[3], q[3] + h[2] * q[0] + h[0] * q[2] - h[1] * q[1]};
        const double over = 1 / std::sqrt(square());
        for (double& component : q) component *= over;
        batch.history[first][i] = q[0] - 1;
        for (std::size_t k = 1; k < 4; ++k) batch.history[first + k][i] = q[k];
    }
    if (q[1] == 0 && q[2] == 0 && q[3] == 0) return direction;
    const auto& d = direction;
    const std::array<double, 3> cross{q[2] * d[2] - q[3] * d[1], q[3] * d[0] - q[1] * d[2], q[1] * d[1] - q[2] * d[0]};
    return {d[0] + 2 * (q[0] * cross[0] + q[2] * cross[2] - q[3] * cross[1]),
            d[1] + 2 * (q[0] * cross[1] + q[3] * cross[0] - q[1] * cross[2]),
            d[2] + 2 * (q[0] * cross[2] + q[1] * cross[1] - q[2] * cross[0])};
}

} // namespace kaya::zones
