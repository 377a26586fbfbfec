#include "base/deflate.hpp"

#include <new>
#include <zlib.h>

namespace kaya {

std::string deflated(std::string_view bytes) {
    uLongf size = ::compressBound(bytes.size());
    std::string small(size, '\0');
    if (::compress2(reinterpret_cast<Bytef*>(small.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                    bytes.size(), Z_DEFAULT_COMPRESSION) != Z_OK)
        throw std::bad_alloc();
    small.resize(size);
    return small;
}

std::optional<std::string> inflated(std::string_view stream, std::size_t size) {
    constexpr std::size_t greatest_ratio = 1032; // of deflate
    if (size / greatest_ratio > stream.size()) return std::nullopt;
    std::string bytes(size, '\0');
    uLongf length = size;
    const int status = ::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                                    reinterpret_cast<const Bytef*>(stream.data()), stream.size());
    if (status != Z_OK || length != size) return std::nullopt;
    return bytes;
}

} // namespace kaya
