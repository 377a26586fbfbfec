// Principal values and axes of a stress; for zone models that yield in principal stresses.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace kaya::zones {

/// Six components in the order of kaya/zmodel.h: xx, yy, zz, xy, xz, yz.
using Tensor = std::array<double, 6>;

/// value[0] >= value[1] >= value[2]; axis[k] is the unit vector of value[k].
struct Principal {
    std::array<double, 3> value;
    std::array<std::array<double, 3>, 3> axis;

    /// By Jacobi's rotations, whose axes stay at right angles also where values are equal (Golub and Van Loan, Matrix
    /// Computations, 8.5).
    explicit Principal(const Tensor& t) {
        double a[3][3] = {{t[0], t[3], t[4]}, {t[3], t[1], t[5]}, {t[4], t[5], t[2]}};
        double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        constexpr int most_sweeps = 12; // it converges quadratically: five are enough
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            const double off = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2];
            const double on = a[0][0] * a[0][0] + a[1][1] * a[1][1] + a[2][2] * a[2][2];
            if (off <= 1e-32 * on) break;
            for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
                if (a[p][q] == 0) continue;
                const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
                const double tangent = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(tangent * tangent + 1), s = tangent * c;
                for (int k = 0; k < 3; ++k) {
                    const double kp = a[k][p], kq = a[k][q];
                    a[k][p] = c * kp - s * kq;
                    a[k][q] = s * kp + c * kq;
                }
                for (int k = 0; k < 3; ++k) {
                    const double pk = a[p][k], qk = a[q][k];
                    a[p][k] = c * pk - s * qk;
                    a[q][k] = s * pk + c * qk;
                }
                for (int k = 0; k < 3; ++k) {
                    const double kp = v[k][p], kq = v[k][q];
                    v[k][p] = c * kp - s * kq;
                    v[k][q] = s * kp + c * kq;
                }
            }
        }
        std::array<int, 3> order{0, 1, 2};
        const auto put_greater_first = [&](int i, int j) {
            if (a[order[i]][order[i]] < a[order[j]][order[j]]) std::swap(order[i], order[j]);
        };
        put_greater_first(0, 1);
        put_greater_first(1, 2);
        put_greater_first(0, 1);
        for (int k = 0; k < 3; ++k) {
            value[k] = a[order[k]][order[k]];
            for (int i = 0; i < 3; ++i) axis[k][i] = v[i][order[k]];
        }
    }

    /// The tensor with these values along the axes.
    Tensor tensor() const {
        constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
        Tensor t{};
        for (int c = 0; c < 6; ++c)
            for (int k = 0; k < 3; ++k) t[c] += value[k] * axis[k][row[c]] * axis[k][column[c]];
        return t;
    }
};

} // namespace kaya::zones
