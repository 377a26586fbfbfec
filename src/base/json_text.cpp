#include "base/json_text.hpp"

#include <charconv>
#include <cstdint>
#include <fmt/format.h>
#include <optional>

namespace kaya {
namespace {

/// The four hexadecimal digits at the beginning of a text.
std::optional<std::uint32_t> four_digits(std::string_view text) {
    constexpr std::size_t digits = 4;
    std::uint32_t code = 0;
    if (text.size() < digits) return std::nullopt;
    const auto [end, error] = std::from_chars(text.data(), text.data() + digits, code, 16);
    return error == std::errc{} && end == text.data() + digits ? std::optional(code) : std::nullopt;
}

/// The code of a character in UTF-8.
void append(std::string& text, std::uint32_t code) {
    const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
    const auto rest = [&](int shift) { add(0x80 | (code >> shift & 0x3f)); };
    if (code < 0x80) return add(code);
    if (code < 0x800) {
        add(0xc0 | code >> 6);
    } else {
        if (code < 0x10000) {
            add(0xe0 | code >> 12);
        } else {
            add(0xf0 | code >> 18);
            rest(12);
        }
        rest(6);
    }
    rest(0);
}

constexpr bool is_first_half(std::uint32_t code) { return code >= 0xd800 && code < 0xdc00; }
constexpr bool is_second_half(std::uint32_t code) { return code >= 0xdc00 && code < 0xe000; }

/// The character behind \u, and the rest of the text behind it.
std::string take_code(std::string_view& text, std::string& into) {
    const auto first = four_digits(text);
    if (!first)
        return fmt::format("'\\u{}' has no four hexadecimal digits", text.substr(0, text.find('"')).substr(0, 4));
    text.remove_prefix(4);
    std::uint32_t code = *first;
    if (is_second_half(code))
        return fmt::format("'\\u{:04x}' is the second half of a character without the first", code);
    if (is_first_half(code)) {
        const auto second = text.starts_with("\\u") ? four_digits(text.substr(2)) : std::nullopt;
        if (!second || !is_second_half(*second))
            return fmt::format("'\\u{:04x}' is the first half of a character without the second", code);
        text.remove_prefix(6);
        code = 0x10000 + ((code - 0xd800) << 10) + (*second - 0xdc00);
    }
    if (code == 0) return "'\\u0000' is not a character of a name";
    append(into, code);
    return {};
}

} // namespace

std::string json_text(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') result += {'\\', c};
        else if (byte < 32 || c == '<' || c == '>' || c == '&' || byte == 127) result += fmt::format("\\u{:04x}", byte);
        else result += c;
    }
    return result + '"';
}

JsonText json_decoded(std::string_view text) {
    constexpr std::string_view letters = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
    JsonText result;
    std::string_view left = text;
    while (!left.empty() && left.front() != '"') {
        result.length = text.size() - left.size();
        const char c = left.front();
        if (c == '\n') {
            result.wrong = "a quote is not closed";
            return result;
        }
        left.remove_prefix(1);
        if (c != '\\') {
            result.text += c;
            continue;
        }
        const char letter = left.empty() ? '\0' : left.front();
        if (letter == 'u') {
            left.remove_prefix(1);
            result.wrong = take_code(left, result.text);
        } else if (const std::size_t known = letters.find(letter); !left.empty() && known != letters.npos) {
            left.remove_prefix(1);
            result.text += meanings[known];
        } else {
            result.wrong = fmt::format("'\\{}' means nothing in a text", left.substr(0, 1));
        }
        if (!result.wrong.empty()) return result;
    }
    result.length = text.size() - left.size();
    return result;
}

} // namespace kaya
