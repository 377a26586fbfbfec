// Random numbers that are the same on every machine and with every library.
#pragma once

#include <cstdint>

namespace kaya {

/// The generator "splitmix64" (Steele, Lea and Flood 2014): a counter and a mixing function, so numbers
/// of different streams have nothing to do with each other even when the seeds are 1, 2, 3.
class Random {
public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_(mix(seed) ^ mix(~stream)) {}

    std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15ull); }
    /// Uniform in [0, 1).
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// Uniform in [-1, 1).
    double symmetric() { return 2 * uniform() - 1; }

private:
    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    std::uint64_t state_;
};

} // namespace kaya
