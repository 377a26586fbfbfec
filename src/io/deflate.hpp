// Compression by zlib; only deflate.cpp includes its header.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// The bytes as one stream in zlib's format (RFC 1950).
std::string deflated(std::string_view bytes);

} // namespace kaya
