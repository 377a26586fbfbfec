// Principal values and axes of a stress; for zone models that yield in principal stresses.
#pragma once

#include "stdlib/zones/zone.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace kaya::zones {

/// Eigenvalues and axes of N symmetric tensors at once, by Jacobi's rotations, whose axes remain orthogonal also where values are equal
/// (Golub and Van Loan, Matrix Computations, 8.5). Lane by lane: the result of one tensor does not depend on the others.
template <int N> struct Rotations {
    double a[6][N];    ///< the tensors; at the end a[0] to a[2] hold their values
    double axis[9][N]; ///< component k of the axis of value p is axis[3 k + p]

    void run() {
        for (int k = 0; k < 9; ++k)
            for (int l = 0; l < N; ++l) axis[k][l] = k % 4 == 0 ? 1 : 0;
        constexpr int most_sweeps = 12; // it converges quadratically: five are enough
        double turns[N];                // 0 for converged ones, which no longer change
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            double any = 0;
            for (int l = 0; l < N; ++l) {
                const double off = a[3][l] * a[3][l] + a[4][l] * a[4][l] + a[5][l] * a[5][l];
                const double on = a[0][l] * a[0][l] + a[1][l] * a[1][l] + a[2][l] * a[2][l];
                turns[l] = off > 1e-32 * on ? 1 : 0;
                any += turns[l];
            }
            if (any == 0) return;
            rotate<0, 1, 3, 4, 5>(turns);
            rotate<0, 2, 4, 3, 5>(turns);
            rotate<1, 2, 5, 3, 4>(turns);
        }
    }

private:
    /// In the plane of axes P and Q; `Other` components couple them to the third axis.
    template <int P, int Q, int PQ, int OtherP, int OtherQ> void rotate(const double (&turns)[N]) {
        constexpr double nothing = 1e-300; // avoids 0 / 0
        for (int l = 0; l < N; ++l) {
            const double apart = a[Q][l] - a[P][l], twice = 2 * a[PQ][l];
            const double root = std::sqrt(apart * apart + twice * twice) + nothing;
            const double tangent = turns[l] * twice / (apart + std::copysign(root, apart));
            const double c = 1 / std::sqrt(tangent * tangent + 1), s = tangent * c;
            const double change = tangent * a[PQ][l];
            a[P][l] -= change;
            a[Q][l] += change;
            a[PQ][l] -= turns[l] * a[PQ][l];
            const double p = a[OtherP][l], q = a[OtherQ][l];
            a[OtherP][l] = c * p - s * q;
            a[OtherQ][l] = s * p + c * q;
            for (int k = 0; k < 9; k += 3) {
                const double vp = axis[k + P][l], vq = axis[k + Q][l];
                axis[k + P][l] = c * vp - s * vq;
                axis[k + Q][l] = s * vp + c * vq;
            }
        }
    }
};

/// value[0] >= value[1] >= value[2]; axis[k] is the unit vector of value[k].
struct Principal {
    std::array<double, 3> value;
    std::array<std::array<double, 3>, 3> axis;

    template <int N> Principal(const Rotations<N>& done, int lane) {
        std::array<int, 3> order{0, 1, 2};
        const auto put_greater_first = [&](int i, int j) {
            if (done.a[order[i]][lane] < done.a[order[j]][lane]) std::swap(order[i], order[j]);
        };
        put_greater_first(0, 1);
        put_greater_first(1, 2);
        put_greater_first(0, 1);
        for (int k = 0; k < 3; ++k) {
            value[k] = done.a[order[k]][lane];
            for (int i = 0; i < 3; ++i) axis[k][i] = done.axis[3 * i + order[k]][lane];
        }
    }
    explicit Principal(const Tensor& t) : Principal(of_one(t), 0) {}

    /// The tensor with these values along the axes.
    Tensor tensor() const {
        constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
        Tensor t{};
        for (int c = 0; c < 6; ++c)
            for (int k = 0; k < 3; ++k) t[c] += value[k] * axis[k][row[c]] * axis[k][column[c]];
        return t;
    }

private:
    static Rotations<1> of_one(const Tensor& t) {
        Rotations<1> one;
        for (int k = 0; k < 6; ++k) one.a[k][0] = t[k];
        one.run();
        return one;
    }
};

/// Bounds of the greatest and the least principal stress, without axes: with the invariants of the deviator
///     s1 = mean + r c(t),  s3 = mean - r c(-t),  r = 2 sqrt(J2/3),  t = cos 3 theta = 4 J3/r^3,  4 c^3 - 3 c = t,  c >= 1/2
/// (Nayak and Zienkiewicz 1972). Newton's steps for c from 1 converge from above.
struct Bounds {
    double high, low;

    [[gnu::always_inline]] static Bounds of(double xx, double yy, double zz, double xy, double xz, double yz) {
        constexpr double rounding = 1e-12, doubt = 1e-9, nothing = 1e-300;
        const double mean = (xx + yy + zz) / 3, x = xx - mean, y = yy - mean, z = zz - mean;
        const double second =
            ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) / 6 + xy * xy + xz * xz + yz * yz;
        const double third = x * y * z + 2 * xy * xz * yz - x * yz * yz - y * xz * xz - z * xy * xy;
        const double r = 2 * std::sqrt(second / 3), size = std::abs(mean) + r;
        const double t = 4 * third / (r * r * r + nothing), around = doubt + rounding * size / (r + nothing);
        const double small = rounding * size;
        return {mean + r * cosine(t + around) + small, mean - r * cosine(around - t) - small};
    }

    /// The same with c = 1, for any angle: cheaper, and sufficient far from yielding. Without divisions, which take longer than all the rest.
    [[gnu::always_inline]] static Bounds wide(double xx, double yy, double zz, double xy, double xz, double yz) {
        constexpr double rounding = 1e-12, third = 1.0 / 3;
        const double mean = (xx + yy + zz) * third;
        const double normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx);
        const double r = std::sqrt(normal * (2 * third / 3) + (xy * xy + xz * xz + yz * yz) * (4 * third)); // 4/3 J2
        const double reach = r + rounding * (std::abs(mean) + r);
        return {mean + reach, mean - reach};
    }

private:
    [[gnu::always_inline]] static double cosine(double t) {
        constexpr int steps = 5;
        const double most = t < 1 ? t : 1; // also where it is NaN
        double c = 1;
        for (int i = 0; i < steps; ++i) c -= (c * (4 * c * c - 3) - most) / (12 * c * c - 3);
        return c;
    }
};

/// Calls each(row, principal) for the rows of a batch that may yield. `holds(row, high, low)` returns whether a stress is certainly within
/// the strength: `high` is an upper bound of the greatest principal stress, `low` a lower bound of the least. Most rows need only these
/// bounds; principal stresses of the others are computed eight at a time.
template <class Holds, class Each> void for_rows_that_may_yield(const kaya_zbatch& batch, Holds holds, Each each) {
    constexpr std::size_t chunk = 64;
    constexpr int pack = 8;
    for (std::size_t first = 0; first < batch.n; first += chunk) {
        const std::size_t count = batch.n - first < chunk ? batch.n - first : chunk;
        double high[chunk], low[chunk];
        const auto find = [&](auto bounds_of) {
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t r = first + i;
                const Bounds bounds = bounds_of(batch.stress[0][r], batch.stress[1][r], batch.stress[2][r],
                                                batch.stress[3][r], batch.stress[4][r], batch.stress[5][r]);
                high[i] = bounds.high, low[i] = bounds.low;
            }
        };
        find([](auto... stress) { return Bounds::wide(stress...); });
        std::uint64_t others = 0; // counted, so that it is a vector loop
        for (std::size_t i = 0; i < count; ++i) others += !holds(first + i, high[i], low[i]);
        if (others == 0) continue;
        find([](auto... stress) { return Bounds::of(stress...); });
        std::size_t rows[chunk], some = 0;
        for (std::size_t i = 0; i < count; ++i) {
            rows[some] = first + i;
            some += !holds(first + i, high[i], low[i]);
        }
        for (std::size_t next = 0; next < some; next += pack) {
            Rotations<pack> rotations;
            const std::size_t here = some - next < pack ? some - next : pack;
            for (std::size_t l = 0; l < pack; ++l)
                for (int k = 0; k < 6; ++k) rotations.a[k][l] = batch.stress[k][rows[next + (l < here ? l : 0)]];
            rotations.run();
            for (std::size_t l = 0; l < here; ++l) {
                Principal principal(rotations, static_cast<int>(l));
                each(rows[next + l], principal);
            }
        }
    }
}

} // namespace kaya::zones
