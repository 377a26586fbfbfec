// Compression by zlib, whose header only deflate.cpp sees.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// The bytes as one stream in zlib's format (RFC 1950).
std::string deflated(std::string_view bytes);

} // namespace kaya
