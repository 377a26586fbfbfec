// Messages on a narrow terminal.
#include "commands/program/fitted.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

TEST(FittedText, BreaksBetweenWordsAndContinuesIndented) {
    EXPECT_EQ(fitted("note: one of: stress, xgradient, ygradient, range", 24),
              "note: one of: stress,\n    xgradient,\n    ygradient, range");
    EXPECT_EQ(fitted("short\nand short", 24), "short\nand short");
}

TEST(FittedText, LeavesLinesOfTheDeckAndThePlaceOfTheUnderline) {
    EXPECT_EQ(fitted("   1 | poly brick 0 1 0 1 0 1\n     |      ^^^^^ did you mean what you say", 26),
              "   1 | poly brick 0 1 0 1 0 1\n     |      ^^^^^ did you\n       mean what you say");
}

TEST(FittedText, CountsLettersNotBytesAndNoColours) {
    EXPECT_EQ(fitted("\033[31merror\033[0m: äöüäöüäöü ok", 19), "\033[31merror\033[0m: äöüäöüäöü ok");
    EXPECT_EQ(fitted("a-word-that-is-longer-than-the-screen", 20), "a-word-that-is-longer-than-the-screen");
}

} // namespace
} // namespace kaya
