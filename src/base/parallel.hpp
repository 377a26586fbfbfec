// Parallel loops whose result does not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace kaya {

/// How many threads the loops below may use. Changing it changes no number, only the time.
void set_threads(int count);
int threads();

/// Calls body(first, last) for consecutive chunks of [0, n). The chunks depend on n and grain only,
/// never on the number of threads, and body must write only to rows of its own chunk.
/// An exception from body is rethrown here after the loop has ended (the one of the lowest chunk).
void for_chunks(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

} // namespace kaya
