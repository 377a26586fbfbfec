#include "base/parallel.hpp"

#include "base/stop_point.hpp"
#include "base/thread_team.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#ifdef __SANITIZE_THREAD__
#include <thread>
#include <vector>
#endif

namespace kaya {

namespace {

std::atomic<int> thread_count = 1;
std::mutex of_limit; ///< sessions of a process may begin in several threads
std::unique_ptr<oneapi::tbb::global_control> limit;

/// Calls call(c) for every c in [0, count), on all of so many threads.
template <class Call> void spread(std::size_t count, [[maybe_unused]] int of_threads, const Call& call) {
#ifdef __SANITIZE_THREAD__
    // The thread sanitizer does not see how TBB's library hands work to its threads and would report every
    // loop. With plain threads it reports the races that are ours.
    const auto stride = static_cast<std::size_t>(of_threads);
    std::vector<std::jthread> team;
    for (std::size_t t = 0; t < std::min(stride, count); ++t)
        team.emplace_back([&call, t, count, stride] {
            for (std::size_t c = t; c < count; c += stride) call(c);
        });
#else
    oneapi::tbb::parallel_for(std::size_t{0}, count, std::size_t{1}, call, oneapi::tbb::static_partitioner{});
#endif
}

} // namespace

void set_threads(int count) {
    const int allowed = std::max(1, count);
    const std::lock_guard guard(of_limit);
    thread_count = allowed;
    limit = std::make_unique<oneapi::tbb::global_control>(oneapi::tbb::global_control::max_allowed_parallelism,
                                                          static_cast<std::size_t>(allowed));
}

int threads() {
    const ThreadTeam* const team = ThreadTeam::of_this_thread();
    return team ? team->count() : thread_count.load();
}

void for_chunks(std::size_t n, std::size_t grain, ChunkBody body) {
    if (n == 0) return;
    grain = std::max<std::size_t>(grain, 1);
    const std::size_t chunks = (n + grain - 1) / grain;
    const int allowed = threads();
    if (chunks == 1 || allowed == 1) {
        for (std::size_t c = 0; c < chunks; ++c) body(c * grain, std::min(n, (c + 1) * grain));
        return;
    }
    std::mutex mutex;
    std::exception_ptr first;
    std::atomic<std::size_t> first_chunk = chunks;
    const StopListener* const of_caller = StopListener::of_this_thread();
    const ThreadTeam* const team = ThreadTeam::of_this_thread();
    const auto call = [&](std::size_t c) {
        const SameListener listens(of_caller);
        const WithTeam loops_inside(team);
        if (c > first_chunk.load(std::memory_order_relaxed)) return; // its result or exception would be discarded
        try {
            body(c * grain, std::min(n, (c + 1) * grain));
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (c < first_chunk) {
                first_chunk = c;
                first = std::current_exception();
            }
        }
    };
    const auto work = [&] { spread(chunks, allowed, call); };
    if (team) team->enter(std::ref(work));
    else work();
    if (first) std::rethrow_exception(first);
}

} // namespace kaya
