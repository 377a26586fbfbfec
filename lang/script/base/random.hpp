// Random numbers that are the same on every machine and survive save and restore.
#pragma once

#include <array>
#include <cstdint>

namespace kaya::script {

/// xoshiro256** (Blackman and Vigna 2018), seeded through splitmix64.
class Random {
public:
    explicit Random(std::uint64_t seed = 1) { this->seed(seed); }

    void seed(std::uint64_t seed);
    std::uint64_t bits();
    double uniform();  ///< [0, 1), 53 bits
    double gaussian(); ///< mean 0, standard deviation 1 (Marsaglia's polar method, one value per pair)

    std::array<std::uint64_t, 4> state{};
};

} // namespace kaya::script
