#include "io/deflate.hpp"

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

} // namespace kaya
