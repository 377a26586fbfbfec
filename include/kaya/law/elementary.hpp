// SPDX-License-Identifier: MIT
// Logarithm, exponential, tangent and arctangent that the compiler can put into vector instructions.
//
// The functions of the C library are calls, one number at a time, and their last bits differ between
// versions of the library. These are plain arithmetic: every machine gives the same bits, and a loop
// that uses them becomes vector instructions. Relative errors are below 1e-15, those of the tangent
// below 1e-15 to 70 degrees and 3e-14 at 89.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace kaya::joints {

/// The first n coefficients of a power series, made by the compiler.
template <std::size_t n> consteval std::array<double, n> series(double (*coefficient)(std::size_t)) {
    std::array<double, n> table{};
    for (std::size_t k = 0; k < n; ++k) table[k] = coefficient(k);
    return table;
}

constexpr double factorial(std::size_t n) { return n < 2 ? 1 : static_cast<double>(n) * factorial(n - 1); }

template <std::size_t n>
[[gnu::always_inline]] inline double polynomial(const std::array<double, n>& coefficients, double x) {
    double sum = coefficients[n - 1];
#pragma GCC unroll 32
    for (std::size_t k = n - 1; k > 0; --k) sum = coefficients[k - 1] + x * sum;
    return sum;
}

/// Natural logarithm; x must be a normal number above 0.
[[gnu::always_inline]] inline double logarithm(double x) {
    // x = 2^e m with m from 1 to 2; the exponent becomes a number by being put in the last bits of 2^52.
    const auto bits = std::bit_cast<std::uint64_t>(x);
    double e = std::bit_cast<double>(0x4330'0000'0000'0000 | (bits >> 52)) - (0x1p52 + 1023);
    double m = std::bit_cast<double>((bits & 0x000f'ffff'ffff'ffff) | 0x3ff0'0000'0000'0000);
    const bool upper = m > std::numbers::sqrt2; // centre m about 1
    m = upper ? 0.5 * m : m;
    e = upper ? e + 1 : e;
    // ln m = 2 artanh f, f = (m - 1)/(m + 1), at most 0.172
    constexpr auto artanh = series<10>([](std::size_t k) { return 1.0 / static_cast<double>(2 * k + 1); });
    const double f = (m - 1) / (m + 1);
    return e * std::numbers::ln2 + 2 * f * polynomial(artanh, f * f);
}

/// e to the power x; x from -700 to 700.
[[gnu::always_inline]] inline double exponential(double x) {
    // x = k ln 2 + r. Adding 1.5 * 2^52 rounds to an integer and leaves it in the last bits.
    constexpr double shift = 0x1.8p52;
    constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33; // k * high is exact
    const double shifted = x * std::numbers::log2e + shift;
    const double k = shifted - shift;
    const double r = (x - k * ln2_high) - k * ln2_low;
    constexpr auto taylor = series<14>([](std::size_t n) { return 1 / factorial(n); });
    const double two_to_k = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
    return two_to_k * polynomial(taylor, r);
}

/// x to the power y, x above 0.
[[gnu::always_inline]] inline double power(double x, double y) { return exponential(y * logarithm(x)); }

/// Of the series of sine and cosine, in even powers.
constexpr double sine_term(std::size_t k) { return (k % 2 ? -1 : 1) / factorial(2 * k + 1); }
constexpr double cosine_term(std::size_t k) { return (k % 2 ? -1 : 1) / factorial(2 * k); }

/// Tangent of an angle in degrees, from -89 to 89.
[[gnu::always_inline]] inline double tangent_of_degrees(double angle) {
    // From sine and cosine of the half angle, at most 45 degrees: tan = 2 s c / (c^2 - s^2).
    constexpr auto sine = series<9>(sine_term), cosine = series<9>(cosine_term);
    const double h = angle * (std::numbers::pi / 360), q = h * h;
    const double s = h * polynomial(sine, q), c = polynomial(cosine, q);
    return 2 * s * c / (c * c - s * s);
}

/// Angle in degrees of a tangent from 0 on.
[[gnu::always_inline]] inline double arctangent_in_degrees(double x) {
    // The smaller of the angle and its complement to 90 degrees, less 45 degrees where it is above 22.5: at most 22.5 degrees.
    const bool steep = x > 1;
    const double t = steep ? 1 / x : x;
    const bool beyond = t > std::numbers::sqrt2 - 1;
    const double u = beyond ? (t - 1) / (t + 1) : t, q = u * u;
    constexpr auto arctan =
        series<22>([](std::size_t k) { return (k % 2 ? -1.0 : 1.0) / static_cast<double>(2 * k + 1); });
    const double near = u * polynomial(arctan, q) * (180 / std::numbers::pi);
    const double below = beyond ? 45 + near : near;
    return steep ? 90 - below : below;
}

} // namespace kaya::joints
