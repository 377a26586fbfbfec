#include "base/hash.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace {

std::uint64_t digest(std::string_view bytes) {
    kaya::Hash hash;
    hash.add(bytes.data(), bytes.size());
    return hash.value();
}

TEST(Hash, EqualBytesGiveEqualDigests) { EXPECT_EQ(digest("the same state"), digest("the same state")); }

TEST(Hash, EveryBitCounts) {
    std::array<unsigned char, 19> bytes{};
    const auto value = [&] {
        kaya::Hash hash;
        hash.add(bytes.data(), bytes.size());
        return hash.value();
    };
    const auto zero = value();
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        bytes[bit / 8] ^= static_cast<unsigned char>(1u << (bit % 8));
        EXPECT_NE(value(), zero) << "bit " << bit;
        bytes[bit / 8] = 0;
    }
}

TEST(Hash, OrderCounts) {
    EXPECT_NE(digest("12345678abcdefgh"), digest("abcdefgh12345678"));
    EXPECT_NE(digest("ab"), digest("ba"));
}

// Otherwise one column could become longer at the expense of the next without a change of the hash.
TEST(Hash, BorderBetweenTextsCounts) {
    kaya::Hash one, other;
    one.add("ab");
    one.add("c");
    other.add("a");
    other.add("bc");
    EXPECT_NE(one.value(), other.value());
}

TEST(Hash, MinusZeroIsNotZero) {
    const double plus = 0.0, minus = -0.0;
    kaya::Hash a, b;
    a.add(&plus, sizeof plus);
    b.add(&minus, sizeof minus);
    EXPECT_NE(a.value(), b.value());
}

} // namespace
