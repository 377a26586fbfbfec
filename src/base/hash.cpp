#include "base/hash.hpp"

#include <cstring>

namespace kaya {

// Eight bytes at a time with a multiply and a fold; the tail byte by byte (FNV-1a).
void Hash::add(const void* data, std::size_t bytes) {
    const auto* p = static_cast<const unsigned char*>(data);
    std::uint64_t h = state_;
    for (; bytes >= 8; bytes -= 8, p += 8) {
        std::uint64_t word;
        std::memcpy(&word, p, 8);
        h = (h ^ word) * 0x9e3779b97f4a7c15ull;
        h ^= h >> 32;
    }
    for (; bytes > 0; --bytes, ++p) h = (h ^ *p) * 0x100000001b3ull;
    state_ = h;
}

} // namespace kaya
