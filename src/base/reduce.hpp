// Sums and extremes whose bits do not depend on the number of threads.
#pragma once

#include "base/parallel.hpp"

#include <vector>

namespace kaya {

/// Calls body(first, last) -> Part for consecutive chunks and folds the parts in chunk order:
/// combine(result, part).
template <class Part, class Body, class Combine>
Part reduce_chunks(std::size_t n, std::size_t grain, Part result, Body body, Combine combine) {
    if (n <= grain) {
        if (n > 0) combine(result, body(std::size_t{0}, n));
        return result;
    }
    static thread_local std::vector<Part> parts; // kept, so that a steady cycle allocates nothing
    parts.assign((n + grain - 1) / grain, Part{});
    Part* const out = parts.data(); // of this thread, whichever thread writes to it
    for_chunks(n, grain, [&](std::size_t first, std::size_t last) { out[first / grain] = body(first, last); });
    for (const Part& part : parts) combine(result, part);
    return result;
}

} // namespace kaya
