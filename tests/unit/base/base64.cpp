#include "base/base64.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

// The examples of RFC 4648, section 10.
TEST(Base64, WritesTheExamplesOfItsStandard) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Base64, ReadsPartsWithPaddingAndBlanks) {
    const std::string text = base64("four") + "\n  " + base64("and seven") + base64("x");
    Base64Reader reader(text);
    EXPECT_EQ(reader.take(4), "four");
    EXPECT_EQ(reader.take(0), "");
    EXPECT_EQ(reader.take(3), "and");
    EXPECT_EQ(reader.take(7), " sevenx");
    EXPECT_EQ(reader.take(1), std::nullopt);
}

TEST(Base64, RefusesOtherCharactersAndClaimsBeyondTheText) {
    for (const char* text : {"QU", "QUI", "Q=Q=", "QU=B", "====", "QUI*", "QUI"})
        EXPECT_EQ(Base64Reader(text).take(2), std::nullopt) << text;
    EXPECT_EQ(Base64Reader("QUJD").take(std::size_t{1} << 60), std::nullopt);
    std::string all;
    for (int k = 0; k < 256; ++k) all += static_cast<char>(k);
    EXPECT_EQ(Base64Reader(base64(all)).take(256), all);
}

} // namespace
} // namespace kaya
