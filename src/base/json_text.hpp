// Texts of JSON.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// A text in quotes as JSON has it, without characters that mean something inside of a script or a page. Bytes that are not ASCII stay.
std::string json_text(std::string_view text);

/// A text that was read, up to the quote that ends it, or the end of all.
struct JsonText {
    std::string text;       ///< in UTF-8
    std::size_t length = 0; ///< of what was read, without the quotes
    std::string wrong;      ///< what is wrong behind that length; "": nothing
};

/// Decodes what stands behind the first quote of a text of JSON, as RFC 8259 has it: \uD83D\uDE00 is one character.
JsonText json_decoded(std::string_view text);

} // namespace kaya
