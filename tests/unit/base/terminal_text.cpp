#include "base/terminal_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

namespace kaya {
namespace {

struct Row {
    std::string text, shown;
};

TEST(TerminalText, ShowsWhatATerminalWouldObey) {
    const std::vector<Row> rows{
        {"", ""},
        {"plain text, 1.5\n\tin two lines", "plain text, 1.5\n\tin two lines"},
        {"Gr\u00f6\u00dfe \u03c3 \u4f60 \U0001F600", "Gr\u00f6\u00dfe \u03c3 \u4f60 \U0001F600"},
        {"\x1b[2J\x1b]0;title\x07", "\\x1b[2J\\x1b]0;title\\x07"},
        {"over\rwritten\b\b", "over\\x0dwritten\\x08\\x08"},
        {std::string("a\0b", 3), "a\\x00b"},
        {"\x7f", "\\x7f"},
        {"\xc2\x80 \xc2\x9b 31m \xc2\x9f \xc2\xa0", "\\xc2\\x80 \\xc2\\x9b 31m \\xc2\\x9f \xc2\xa0"},
        {"\x9b", "\\x9b"},                                       // C1 of another encoding
        {"caf\xe9 au lait", "caf\\xe9 au lait"},                 // Latin-1
        {"cut \xc3", "cut \\xc3"},                               // a character that does not end
        {"cut \xe2\x82 more", "cut \\xe2\\x82 more"},            // nor does this
        {"\xc0\x9b \xe0\x82\x9b", "\\xc0\\x9b \\xe0\\x82\\x9b"}, // C1 with more bytes than it needs
        {"\xed\xa0\x80", "\\xed\\xa0\\x80"},                     // a surrogate
        {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},            // beyond the last code point
        {"deck\u202E3dd.\u202C", "deck\\xe2\\x80\\xae3dd.\\xe2\\x80\\xac"},
        {"a\u200Eb\u061C", "a\\xe2\\x80\\x8eb\\xd8\\x9c"},
        {"a\u2066b\u2069", "a\\xe2\\x81\\xa6b\\xe2\\x81\\xa9"},
    };
    for (const auto& [text, shown] : rows) EXPECT_EQ(terminal_text(text), shown);
}

TEST(TerminalText, EveryByte) {
    for (int byte = 0; byte < 256; ++byte) {
        const bool plain = byte == '\n' || byte == '\t' || (byte >= 0x20 && byte < 0x7f);
        const std::string text(1, static_cast<char>(byte));
        EXPECT_EQ(terminal_text(text), plain ? text : fmt::format("\\x{:02x}", byte));
    }
}

/// Whether a terminal obeys a byte of it, in UTF-8 or in any encoding of single bytes that has ASCII below.
bool is_obeyed(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f) return true;
        if (byte == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0) return true;
    }
    return false;
}

TEST(TerminalText, AnyBytesAndTwice) {
    std::mt19937 random(20261126);
    std::uniform_int_distribution<int> byte(0, 255), size(0, 40);
    for (int k = 0; k < 20000; ++k) {
        std::string text(static_cast<std::size_t>(size(random)), ' ');
        for (char& c : text)
            c = static_cast<char>(k % 2 ? byte(random) : "\x1b\xc2\x9b\xe2\x80\xae[m a\r"[byte(random) % 11]);
        const std::string shown = terminal_text(text);
        EXPECT_FALSE(is_obeyed(shown)) << shown;
        EXPECT_EQ(terminal_text(shown), shown);
    }
}

TEST(TerminalText, PrintsTheSame) {
    std::FILE* stream = std::tmpfile();
    ASSERT_TRUE(print_text(stream, "\x1b"
                                   "a\xc2\x9b\nb\u00e9\xff"));
    std::rewind(stream);
    char bytes[64]{};
    const std::size_t count = std::fread(bytes, 1, sizeof bytes, stream);
    std::fclose(stream);
    EXPECT_EQ(std::string(bytes, count), "\\x1ba\\xc2\\x9b\nb\u00e9\\xff");
}

} // namespace
} // namespace kaya
