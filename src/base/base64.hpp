// Bytes as text: base64 of RFC 4648.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace kaya {

std::string base64(std::string_view bytes);

/// Bytes of a text of one or several parts, each padded at its end. Blanks and ends of lines between the digits are left out.
class Base64Reader {
public:
    explicit Base64Reader(std::string_view text) : text_(text) {}
    /// The next bytes; nothing where the text ends before or has other characters.
    std::optional<std::string> take(std::size_t count);

private:
    bool read_three();

    std::string_view text_;
    std::size_t at_ = 0;
    std::string left_; ///< decoded, and not yet taken
};

} // namespace kaya
