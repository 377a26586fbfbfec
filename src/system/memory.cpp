#include "system/memory.hpp"

#include "system/door.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__
#include <sys/mman.h>
#include <sys/resource.h>
#endif

namespace kaya {

void give_back_memory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20); // the most that it takes
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

namespace {

/// An entry of the system's memory table, in bytes; the largest number where the system has none.
std::size_t memory_entry(const std::string& name) {
    std::istringstream table(door::system_text("/proc/meminfo"));
    std::string word;
    while (table >> word)
        if (std::size_t kilobytes = 0; word == name && table >> kilobytes) return kilobytes << 10;
    return std::numeric_limits<std::size_t>::max();
}

} // namespace

std::size_t memory_of_machine() {
    const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(page) : 0;
}

std::size_t memory_available() { return memory_entry("MemAvailable:"); }

void limit_memory_to_available() {
    // Sanitizers reserve far more than there is.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    constexpr std::size_t unknown = std::numeric_limits<std::size_t>::max();
    const std::size_t all = memory_entry("MemTotal:"), swap = memory_entry("SwapFree:");
    rlimit limit{};
    if (all == unknown || getrlimit(RLIMIT_DATA, &limit) != 0) return;
    // Other programs may release memory during a long run.
    const rlim_t wanted = std::max(memory_available(), all / 2) + (swap == unknown ? 0 : swap);
    if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= wanted) return;
    limit.rlim_cur = wanted;
    setrlimit(RLIMIT_DATA, &limit);
#endif
}

void use_large_pages([[maybe_unused]] std::vector<Bytes> arrays) {
#ifdef __linux__
    constexpr int collapse = 25; // MADV_COLLAPSE, which the headers of an older C library lack
    constexpr std::uintptr_t page = 2u << 20;
    const auto begin_of = [](const Bytes& array) { return reinterpret_cast<std::uintptr_t>(array.first); };
    std::ranges::sort(arrays, std::less<>(), begin_of);
    for (std::size_t i = 0; i < arrays.size();) {
        const std::uintptr_t first = begin_of(arrays[i]);
        std::uintptr_t last = first;
        for (; i < arrays.size() && begin_of(arrays[i]) <= last + page; ++i)
            last = std::max(last, begin_of(arrays[i]) + arrays[i].count);
        const std::uintptr_t begin = (first + page - 1) / page * page, end = last / page * page;
        // Page by page: one that cannot be made large must not keep the others from it.
        for (auto at = begin; at < end; at += page) madvise(reinterpret_cast<void*>(at), page, collapse);
    }
#endif
}

} // namespace kaya
