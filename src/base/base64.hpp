// Bytes as text: base64 of RFC 4648.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

std::string base64(std::string_view bytes);

} // namespace kaya
