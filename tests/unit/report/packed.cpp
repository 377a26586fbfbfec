#include "report/packed.hpp"

#include <array>
#include <gtest/gtest.h>
#include <vector>
#include <zlib.h>

namespace kaya {
namespace {

std::string unpacked(const std::string& text, std::size_t size) {
    std::string small;
    unsigned bits = 0, held = 0;
    for (const char c : text) {
        const auto digit = std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
        if (digit == std::string::npos) break;
        bits = bits << 6 | static_cast<unsigned>(digit), held += 6;
        if (held >= 8) held -= 8, small += static_cast<char>(bits >> held & 255);
    }
    std::string bytes(size, '\0');
    uLongf length = size;
    EXPECT_EQ(::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length, reinterpret_cast<const Bytef*>(small.data()), small.size()), Z_OK);
    bytes.resize(length);
    return bytes;
}

TEST(Packed, AnyBytesComeBack) {
    std::string bytes;
    unsigned random = 7;
    for (int size = 0; size < 300; ++size) {
        EXPECT_EQ(unpacked(packed_bytes(bytes), bytes.size() + 1), bytes);
        EXPECT_EQ(packed_bytes(bytes).size() % 4, 0U);
        bytes += static_cast<char>(random = random * 1664525U + 1013904223U, random >> 24);
    }
}

TEST(Packed, NumbersAreTheirBytes) {
    const std::vector<float> numbers{1.5F, -2.25F, 1e30F};
    const std::string bytes = unpacked(packed(std::span(numbers)), 100);
    ASSERT_EQ(bytes.size(), 12U);
    EXPECT_EQ(reinterpret_cast<const float*>(bytes.data())[1], -2.25F);
}

TEST(Packed, TextsCannotLeaveTheirPlace) {
    EXPECT_EQ(json_text("a\"b\\c</script>\n"), "\"a\\\"b\\\\c\\u003c/script\\u003e\\u000a\"");
    EXPECT_EQ(html_text("<a href='x'>&\"\x01"), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;");
}

} // namespace
} // namespace kaya
