// Memory of which each thread has its own.
#pragma once

#include <oneapi/tbb/enumerable_thread_specific.h>

namespace kaya {

/// A T for each thread, which gets it by local(). Whoever runs a parallel loop owns it and passes the thread's own down, so that
/// what a call keeps for the next one shows in its arguments. Which thread has which rows is chance: no result may depend on
/// what is in it.
template <class T> using PerThread = oneapi::tbb::enumerable_thread_specific<T>;

} // namespace kaya
