// Compression by zlib; only deflate.cpp includes its header.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kaya {

/// The bytes as one stream in zlib's format (RFC 1950).
std::string deflated(std::string_view bytes);

/// The bytes that a stream stands for; nothing where it is damaged or stands for another number of bytes. A size that no stream of that
/// length can have takes no memory.
std::optional<std::string> inflated(std::string_view stream, std::size_t size);

} // namespace kaya
