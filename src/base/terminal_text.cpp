#include "base/terminal_text.hpp"

#include <algorithm>

namespace kaya {

namespace {

unsigned byte_of(std::string_view text, std::size_t place) { return static_cast<unsigned char>(text[place]); }

/// Bytes of a character by the first one; 0: no character of UTF-8 begins with it.
std::size_t bytes_of_character(unsigned first) {
    if (first < 0x80) return 1;
    if (first < 0xC2 || first > 0xF4) return 0;
    return first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
}

struct CodeRange {
    char32_t first, last;
};

/// Code points of valid UTF-8 that are shown as bytes, and those that UTF-8 excludes.
constexpr CodeRange refused[]{
    {0x00, 0x08},     {0x0B, 0x1F},     // C0 but tab and newline
    {0x7F, 0x9F},                       // DEL, C1
    {0x061C, 0x061C}, {0x200E, 0x200F}, // marks of direction
    {0x2028, 0x202E}, {0x2066, 0x2069}, // line ends, and what reverses the direction of the text that follows
    {0xD800, 0xDFFF},                   // surrogates
};

constexpr char32_t least_of_length[]{0, 0, 0x80, 0x800, 0x10000}; ///< a smaller one is written with fewer bytes

/// Bytes of the first character; 0 when its first byte is not for a terminal.
std::size_t printable_bytes(std::string_view text) {
    const unsigned first = byte_of(text, 0);
    const std::size_t size = bytes_of_character(first);
    if (size == 0 || size > text.size()) return 0;
    char32_t code = size == 1 ? first : first & (0xFFu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte_of(text, i) & 0xC0) != 0x80) return 0;
        code = code << 6 | (byte_of(text, i) & 0x3F);
    }
    if (code < least_of_length[size] || code > 0x10FFFF) return 0;
    const auto holds = [code](const CodeRange& range) { return code >= range.first && code <= range.last; };
    return std::ranges::any_of(refused, holds) ? 0 : size;
}

} // namespace

TerminalCharacter first_for_terminal(std::string_view text) {
    constexpr char digits[] = "0123456789abcdef";
    const unsigned first = byte_of(text, 0);
    const std::size_t size = printable_bytes(text);
    if (size == 0) return {1, 4, {'\\', 'x', digits[first >> 4], digits[first & 15]}};
    TerminalCharacter whole{size, size, {}};
    text.copy(whole.bytes, size);
    return whole;
}

namespace {

/// Passes the text on in as few parts as possible, until one is refused; allocates nothing.
template <class Take> bool for_parts(std::string_view text, Take&& take) {
    while (!text.empty()) {
        std::size_t whole = 0;
        while (whole < text.size()) {
            const std::size_t size = printable_bytes(text.substr(whole));
            if (size == 0) break;
            whole += size;
        }
        if (whole > 0 && !take(text.substr(0, whole))) return false;
        text.remove_prefix(whole);
        if (text.empty()) break;
        const auto character = first_for_terminal(text);
        if (!take(std::string_view(character.bytes, character.size))) return false;
        text.remove_prefix(character.taken);
    }
    return true;
}

} // namespace

std::string terminal_text(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for_parts(text, [&](std::string_view part) {
        result += part;
        return true;
    });
    return result;
}

bool print_text(std::FILE* stream, std::string_view text) {
    return for_parts(text, [stream](std::string_view part) {
        return std::fwrite(part.data(), 1, part.size(), stream) == part.size();
    });
}

void clear_line(std::FILE* terminal) { std::fputs("\r\033[K", terminal); }

} // namespace kaya
