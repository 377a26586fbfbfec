#include "base/memory.hpp"

#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace kaya {

void give_back_memory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

std::size_t memory_available() {
    std::ifstream table("/proc/meminfo");
    std::string word;
    while (table >> word)
        if (std::size_t kilobytes = 0; word == "MemAvailable:" && table >> kilobytes) return kilobytes << 10;
    return std::numeric_limits<std::size_t>::max();
}

void use_large_pages([[maybe_unused]] const void* first, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    constexpr int collapse = 25; // MADV_COLLAPSE, which the headers of an older C library lack
    constexpr std::uintptr_t page = 2u << 20;
    const auto address = reinterpret_cast<std::uintptr_t>(first);
    const std::uintptr_t begin = (address + page - 1) / page * page, end = (address + bytes) / page * page;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, collapse);
#endif
}

} // namespace kaya
