#include "base/deflate.hpp"

#include <gtest/gtest.h>

using namespace kaya;

TEST(Deflate, ReturnsTheBytes) {
    for (const std::string& bytes : {std::string(), std::string("a"), std::string(1000000, 'x')})
        EXPECT_EQ(inflated(deflated(bytes), bytes.size()), bytes);
}

TEST(Deflate, RefusesDamageOtherSizesAndClaimsThatNoStreamMeets) {
    std::string stream = deflated("a text of some length, of some length, of some length");
    EXPECT_EQ(inflated(stream, 54), std::nullopt);
    EXPECT_EQ(inflated(stream, 52), std::nullopt);
    EXPECT_EQ(inflated(std::string_view(stream).substr(0, 20), 53), std::nullopt);
    EXPECT_EQ(inflated(stream, std::size_t{1} << 50), std::nullopt);
    EXPECT_EQ(inflated("", 1), std::nullopt);
    stream[10] ^= 1;
    EXPECT_EQ(inflated(stream, 53), std::nullopt);
}
