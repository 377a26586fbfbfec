// Logarithm, exponential and tangent that the compiler can put into vector instructions.
//
// The functions of the C library are calls, one number at a time, and their last bits differ between
// versions of the library. These are plain arithmetic: every machine gives the same bits, and a loop
// that uses them becomes vector instructions. Relative errors are below 1e-15, those of the tangent
// below 1e-15 to 70 degrees and 3e-14 at 89.
#pragma once

#include <bit>
#include <cstdint>
#include <numbers>

namespace kaya::joints {

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
    const double f = (m - 1) / (m + 1), s = f * f;
    const double series =
        1 + s * (1.0 / 3 + s * (1.0 / 5 + s * (1.0 / 7 + s * (1.0 / 9 + s * (1.0 / 11 + s * (1.0 / 13 +
        s * (1.0 / 15 + s * (1.0 / 17 + s * (1.0 / 19)))))))));
    return e * std::numbers::ln2 + 2 * f * series;
}

/// e to the power x; x from -700 to 700.
[[gnu::always_inline]] inline double exponential(double x) {
    // x = k ln 2 + r. Adding 1.5 * 2^52 rounds to an integer and leaves it in the last bits.
    constexpr double shift = 0x1.8p52;
    constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33; // k * high is exact
    const double shifted = x * std::numbers::log2e + shift;
    const double k = shifted - shift;
    const double r = (x - k * ln2_high) - k * ln2_low;
    const double series =
        1 + r * (1 + r * (1.0 / 2) * (1 + r * (1.0 / 3) * (1 + r * (1.0 / 4) * (1 + r * (1.0 / 5) * (1 +
        r * (1.0 / 6) * (1 + r * (1.0 / 7) * (1 + r * (1.0 / 8) * (1 + r * (1.0 / 9) * (1 + r * (1.0 / 10) * (1 +
        r * (1.0 / 11) * (1 + r * (1.0 / 12) * (1 + r * (1.0 / 13)))))))))))));
    const double power = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
    return power * series;
}

/// x to the power y, x above 0.
[[gnu::always_inline]] inline double power(double x, double y) { return exponential(y * logarithm(x)); }

/// Tangent of an angle in degrees, from -89 to 89.
[[gnu::always_inline]] inline double tangent_of_degrees(double angle) {
    // From sine s and cosine c of the half angle, at most 45 degrees: tan = 2 s c / (c^2 - s^2).
    const double h = angle * (std::numbers::pi / 360), q = -h * h;
    const double s =
        h * (1 + q * (1.0 / 6) * (1 + q * (1.0 / 20) * (1 + q * (1.0 / 42) * (1 + q * (1.0 / 72) * (1 +
        q * (1.0 / 110) * (1 + q * (1.0 / 156) * (1 + q * (1.0 / 210) * (1 + q * (1.0 / 272)))))))));
    const double c =
        1 + q * (1.0 / 2) * (1 + q * (1.0 / 12) * (1 + q * (1.0 / 30) * (1 + q * (1.0 / 56) * (1 +
        q * (1.0 / 90) * (1 + q * (1.0 / 132) * (1 + q * (1.0 / 182) * (1 + q * (1.0 / 240))))))));
    return 2 * s * c / (c * c - s * s);
}

} // namespace kaya::joints
