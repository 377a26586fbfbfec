// Samples of a run of unknown length: when there are too many, every second one is dropped.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace kaya {

/// The first, the third and so on.
template <class Sample> std::vector<Sample> thinned(std::vector<Sample> samples) {
    std::vector<Sample> kept;
    kept.reserve((samples.size() + 1) / 2);
    for (std::size_t i = 0; i < samples.size(); i += 2) kept.push_back(std::move(samples[i]));
    return kept;
}

} // namespace kaya
