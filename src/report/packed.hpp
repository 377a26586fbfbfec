// Columns of numbers as text that a browser unpacks: deflate (RFC 1950) and base64.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace kaya {

std::string packed_bytes(std::string_view bytes);

template <class Number> std::string packed(std::span<const Number> numbers) {
    return packed_bytes({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
}

/// The text in quotes, for JSON inside of a page: no '<' in it.
std::string json_text(std::string_view text);
/// The text for HTML, also inside of attributes.
std::string html_text(std::string_view text);

} // namespace kaya
