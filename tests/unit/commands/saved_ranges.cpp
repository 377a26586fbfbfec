#include "commands/ranges/saved_ranges.hpp"

#include "base/diagnostic.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

using Kind = lang::RangeElement::Kind;

NamedRanges sample() {
    lang::RangeElement slab;
    slab.kind = Kind::z;
    slab.low = 0.1;
    slab.high = 1.0 / 3.0;
    lang::RangeElement stones;
    stones.kind = Kind::group;
    stones.name = "two words\nand a line";
    stones.negated = true;
    lang::RangeElement ball;
    ball.kind = Kind::sphere;
    ball.centre = Vec3(1, -2e-300, 3);
    ball.radius2 = 5;
    ball.side = -1;
    lang::RangeElement between;
    between.kind = Kind::group_intersection;
    between.name = "a";
    between.second_name = "b b";
    lang::RangeElement listed;
    listed.kind = Kind::id_list;
    listed.numbers = {5, -1, 7};
    listed.both = true;
    listed.vertices = {Vec3(0, 1.0 / 3.0, 2), Vec3(-1e300, 0, 5)};
    return {{"slab", {{slab}, false, {}}},
            {"empty", {}},
            {"any of two", {{stones, ball}, true, {}}},
            {"whole", {{between, listed}, false, {}, true}}};
}

TEST(SavedRanges, AreRestoredBitByBit) {
    const NamedRanges back = ranges_from_text(ranges_text(sample()));
    ASSERT_EQ(back.size(), 4u);
    EXPECT_EQ(back.at("slab").elements[0].kind, Kind::z);
    EXPECT_EQ(back.at("slab").elements[0].high, 1.0 / 3.0);
    EXPECT_TRUE(back.at("empty").elements.empty());
    const auto& both = back.at("any of two");
    EXPECT_TRUE(both.any);
    EXPECT_EQ(both.elements[0].name, "two words\nand a line");
    EXPECT_TRUE(both.elements[0].negated);
    EXPECT_EQ(both.elements[1].centre, Vec3(1, -2e-300, 3));
    EXPECT_EQ(both.elements[1].side, -1);
    const auto& whole = back.at("whole");
    EXPECT_TRUE(whole.whole);
    EXPECT_FALSE(both.whole);
    EXPECT_EQ(whole.elements[0].name, "a");
    EXPECT_EQ(whole.elements[0].second_name, "b b");
    EXPECT_EQ(whole.elements[1].numbers, (std::vector<std::int64_t>{5, -1, 7}));
    EXPECT_TRUE(whole.elements[1].both);
    EXPECT_EQ(whole.elements[1].vertices, (std::vector<Vec3>{Vec3(0, 1.0 / 3.0, 2), Vec3(-1e300, 0, 5)}));
    EXPECT_EQ(ranges_text(back), ranges_text(sample()));
}

TEST(SavedRanges, ATextThatIsCutOffIsRefused) {
    const std::string text = ranges_text(sample());
    // The last character is an optional line end.
    for (std::size_t length = 0; length + 1 < text.size(); ++length)
        EXPECT_THROW(ranges_from_text(text.substr(0, length)), Diagnostic) << length;
}

TEST(SavedRanges, OtherTextIsRefused) {
    EXPECT_THROW(ranges_from_text("not a number"), Diagnostic);
    EXPECT_THROW(ranges_from_text("1\n1 0 1 a\n99 0 0 0x0p+0\n"), Diagnostic);
}

} // namespace
} // namespace kaya
