// Blocks of LZ4; only lz4_block.cpp includes its header.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kaya {

/// The bytes that a block without a frame stands for; nothing where it is damaged or stands for another number of bytes. A size that no block
/// of that length can have takes no memory.
std::optional<std::string> from_lz4(std::string_view block, std::size_t size);

} // namespace kaya
