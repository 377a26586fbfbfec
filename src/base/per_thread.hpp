// Memory that each thread has separately.
#pragma once

#include <oneapi/tbb/enumerable_thread_specific.h>

namespace kaya {

/// A T for each thread, by local(). The owner of a parallel loop owns it and passes each thread's T down, so that memory reused between
/// calls is visible in the arguments. The assignment of rows to threads is random: no result may depend on the contents.
template <class T> using PerThread = oneapi::tbb::enumerable_thread_specific<T>;

} // namespace kaya
