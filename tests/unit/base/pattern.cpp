#include "base/pattern.hpp"

#include <gtest/gtest.h>

using kaya::Pattern;

TEST(Pattern, MatchesAllOfATextOrAPart) {
    const Pattern number("[0-9]+");
    EXPECT_TRUE(number.matches("42"));
    EXPECT_FALSE(number.matches("42 m"));
    EXPECT_TRUE(number.is_in("42 m"));
    EXPECT_FALSE(number.is_in("m"));
}

TEST(Pattern, ListsEachPlaceOrOneGroupOfIt) {
    const Pattern pair("([a-z])=([0-9])");
    const std::vector<std::string> whole{"a=1", "b=2"}, values{"1", "2"};
    EXPECT_EQ(pair.all("a=1, b=2, c"), whole);
    EXPECT_EQ(pair.all("a=1, b=2, c", 2), values);
    EXPECT_TRUE(pair.all("c").empty());
}

TEST(Pattern, EndsOfLinesCount) { EXPECT_EQ(Pattern("^ *[a-z]+$").all("one\n two\nthree 3").size(), 2u); }

TEST(Pattern, LettersOfEitherCaseAreEqualWhereWanted) {
    EXPECT_FALSE(Pattern("yes").is_in("YES"));
    EXPECT_TRUE(Pattern("yes", Pattern::Letters::of_either_case).is_in("YES"));
}
