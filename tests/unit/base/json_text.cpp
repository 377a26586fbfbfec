#include "base/json_text.hpp"

#include <gtest/gtest.h>

using namespace kaya;

namespace {

/// Of a text behind its first quote.
std::string decoded(const std::string& text) {
    const JsonText read = json_decoded(text);
    if (!read.wrong.empty()) return "wrong: " + read.wrong;
    if (read.length == text.size()) return "wrong: no quote ends it";
    EXPECT_EQ(text.substr(read.length, 1), "\"");
    return read.text;
}

} // namespace

TEST(JsonText, TextsCannotLeaveTheirPlace) {
    EXPECT_EQ(json_text("a\"b\\c</script>\n"), "\"a\\\"b\\\\c\\u003c/script\\u003e\\u000a\"");
}

TEST(JsonText, AllCharactersComeBack) {
    std::string all;
    for (int code = 1; code < 128; ++code) all += static_cast<char>(code);
    for (const std::string& text : {all, std::string(), std::string("Gew\xc3\xb6lbe \xe2\x82\xac \xf0\x9f\x98\x80")})
        EXPECT_EQ(decoded(json_text(text).substr(1)), text);
}

TEST(JsonText, EscapesAreThoseOfTheStandard) {
    EXPECT_EQ(decoded(R"(\"\\\/\b\f\n\r\t")"), "\"\\/\b\f\n\r\t");
    EXPECT_EQ(decoded(R"(\u0041\u00f6\u20AC")"), "A\xc3\xb6\xe2\x82\xac");
    EXPECT_EQ(decoded(R"(\u007f\u0080\u07ff\u0800\uffff")"), "\x7f\xc2\x80\xdf\xbf\xe0\xa0\x80\xef\xbf\xbf");
    // Above 16 bits two halves are one character.
    EXPECT_EQ(decoded(R"(x\uD83D\uDE00y")"), "x\xf0\x9f\x98\x80y");
    EXPECT_EQ(decoded(R"(\ud800\udc00\udbff\udfff")"), "\xf0\x90\x80\x80\xf4\x8f\xbf\xbf");
    EXPECT_EQ(json_decoded(R"(ab\u0063" and more)").length, 8U);
}

TEST(JsonText, WrongEscapesAreRefused) {
    EXPECT_EQ(decoded(R"(a\x41")"), R"(wrong: '\x' means nothing in a text)");
    EXPECT_EQ(decoded(R"(a\u00g1")"), R"(wrong: '\u00g1' has no four hexadecimal digits)");
    EXPECT_EQ(decoded(R"(a\u12")"), R"(wrong: '\u12' has no four hexadecimal digits)");
    EXPECT_EQ(decoded(R"(a\u-123")"), R"(wrong: '\u-123' has no four hexadecimal digits)");
    EXPECT_EQ(decoded(R"(a\u0000")"), R"(wrong: '\u0000' is not a character of a name)");
    EXPECT_EQ(decoded(R"(\ud83d")"), R"(wrong: '\ud83d' is the first half of a character without the second)");
    EXPECT_EQ(decoded(R"(\ud83d\n")"), R"(wrong: '\ud83d' is the first half of a character without the second)");
    EXPECT_EQ(decoded(R"(\ud83d\u0041")"), R"(wrong: '\ud83d' is the first half of a character without the second)");
    EXPECT_EQ(decoded(R"(\ude00\ud83d")"), R"(wrong: '\ude00' is the second half of a character without the first)");
    for (const char* open : {"abc", "a\\", "a\\u", "a\\u004", "a\nb\"", ""})
        EXPECT_TRUE(decoded(open).starts_with("wrong: ")) << open;
}
