// Random numbers that depend on the seed alone: distributions of the standard library differ between implementations.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace kaya::test {

class Chance {
public:
    explicit Chance(std::uint64_t seed) : bits_(seed * 2654435769u + 12345) {}

    double between(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }
    /// Uniform in the logarithm.
    double scale(double low, double high) { return std::pow(10, between(std::log10(low), std::log10(high))); }
    int below(int n) { return static_cast<int>(between(0, n)); }
    bool heads(double part = 0.5) { return between(0, 1) < part; }
    /// All 64 bits; the upper ones are of better quality.
    std::uint64_t next() { return bits_ = bits_ * 6364136223846793005u + 1442695040888963407u; }
    /// One of a list that is not empty.
    template <class List> const auto& of(const List& list) {
        return std::begin(list)[below(static_cast<int>(std::size(list)))];
    }

private:
    std::uint64_t bits_;
};

} // namespace kaya::test
