#include "report/packed.hpp"

#include <array>
#include <cmath>
#include <limits>
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
    EXPECT_EQ(::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                           reinterpret_cast<const Bytef*>(small.data()), small.size()),
              Z_OK);
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
    // The bytes of -2.25, 0xc0100000, are three apart.
    EXPECT_EQ(bytes[1], '\0');
    EXPECT_EQ(bytes[4], '\0');
    EXPECT_EQ(bytes[7], '\x10');
    EXPECT_EQ(bytes[10], '\xc0');
}

TEST(Packed, NumbersKeepFiveDigits) {
    for (const float number : {1.0F, -2.25F, 0.0F, 3.14159265F, -1.2345678e-20F, 9.8765432e30F})
        EXPECT_NEAR(rounded(number), number, 1e-5 * std::abs(static_cast<double>(number)));
    EXPECT_EQ(rounded(-2.25F), -2.25F);
    EXPECT_EQ(rounded(std::numeric_limits<float>::max()), std::numeric_limits<float>::max());
    EXPECT_TRUE(std::isnan(rounded(std::nanf(""))));
    EXPECT_EQ(rounded(-std::numeric_limits<float>::infinity()), -std::numeric_limits<float>::infinity());
}

} // namespace
} // namespace kaya
