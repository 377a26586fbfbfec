#include "base/lz4_block.hpp"

#include <lz4.h>

namespace kaya {

std::optional<std::string> from_lz4(std::string_view block, std::size_t size) {
    constexpr std::size_t greatest_ratio = 255; // each byte of a length stands for so many
    constexpr std::size_t most = LZ4_MAX_INPUT_SIZE;
    if (size > most || block.size() > LZ4_COMPRESSBOUND(most) || size / greatest_ratio > block.size())
        return std::nullopt;
    std::string bytes(size, '\0');
    const int length =
        ::LZ4_decompress_safe(block.data(), bytes.data(), static_cast<int>(block.size()), static_cast<int>(size));
    if (length < 0 || static_cast<std::size_t>(length) != size) return std::nullopt;
    return bytes;
}

} // namespace kaya
