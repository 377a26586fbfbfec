// The triangles of a convex polygon.
#pragma once

#include <cstddef>

namespace kaya {

/// Calls call(apex, b, c) for the triangles of the fans from the first `fans` of n corners. The mean over the fans from all corners does not
/// depend on which is the first.
template <class Call> void for_fans(std::size_t fans, std::size_t n, const Call& call) {
    for (std::size_t apex = 0; apex < fans; ++apex)
        for (std::size_t i = 1; i + 1 < n; ++i) call(apex, (apex + i) % n, (apex + i + 1) % n);
}

} // namespace kaya
