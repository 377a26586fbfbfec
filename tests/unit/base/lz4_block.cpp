#include "base/lz4_block.hpp"

#include <gtest/gtest.h>
#include <lz4.h>

using namespace kaya;

namespace {

std::string to_lz4(const std::string& bytes) {
    const int length = static_cast<int>(bytes.size());
    std::string block(static_cast<std::size_t>(LZ4_compressBound(length)), '\0');
    block.resize(static_cast<std::size_t>(
        LZ4_compress_default(bytes.data(), block.data(), length, static_cast<int>(block.size()))));
    return block;
}

} // namespace

TEST(Lz4Block, ReturnsTheBytes) {
    for (const std::string& bytes : {std::string(), std::string("a"), std::string(1000000, 'x')})
        EXPECT_EQ(from_lz4(to_lz4(bytes), bytes.size()), bytes);
}

/// Written by hand after the description of the format: five letters, then a match of 15 bytes two before, then five letters.
TEST(Lz4Block, ReadsAsTheFormatSays) {
    const std::string block("\x5b"
                            "xyzab"
                            "\x02\x00"
                            "\x50"
                            "hello",
                            14);
    EXPECT_EQ(from_lz4(block, 25), std::string("xyzab") + "abababababababa" + "hello");
}

TEST(Lz4Block, RefusesDamageOtherSizesAndClaimsThatNoBlockMeets) {
    const std::string bytes = "a text of some length, of some length, of some length", block = to_lz4(bytes);
    EXPECT_EQ(from_lz4(block, bytes.size() + 1), std::nullopt);
    EXPECT_EQ(from_lz4(block, bytes.size() - 1), std::nullopt);
    for (std::size_t length = 0; length < block.size(); ++length)
        EXPECT_EQ(from_lz4(std::string_view(block).substr(0, length), bytes.size()), std::nullopt) << length;
    EXPECT_EQ(from_lz4(block, std::size_t{1} << 31), std::nullopt);
    EXPECT_EQ(from_lz4(block, std::size_t{1} << 50), std::nullopt);
    EXPECT_EQ(from_lz4("", 1), std::nullopt);
    std::string before = "\x10"
                         "a"
                         "\xff\x00"; // a match that begins before the block
    before.resize(20, '\x10');
    EXPECT_EQ(from_lz4(before, 40), std::nullopt);
}
