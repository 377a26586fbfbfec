// Messages on a narrow terminal.
#include "commands/fitted.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

TEST(FittedText, breaks_between_words_and_goes_on_indented) {
    EXPECT_EQ(fitted("note: one of: stress, xgradient, ygradient, range", 24),
              "note: one of: stress,\n    xgradient,\n    ygradient, range");
    EXPECT_EQ(fitted("short\nand short", 24), "short\nand short");
}

TEST(FittedText, leaves_lines_of_the_deck_and_the_place_of_the_underline) {
    EXPECT_EQ(fitted("   1 | poly brick 0 1 0 1 0 1\n     |      ^^^^^ did you mean what you say", 26),
              "   1 | poly brick 0 1 0 1 0 1\n     |      ^^^^^ did you\n       mean what you say");
}

TEST(FittedText, counts_letters_not_bytes_and_no_colours) {
    EXPECT_EQ(fitted("\033[31merror\033[0m: äöüäöüäöü ok", 19), "\033[31merror\033[0m: äöüäöüäöü ok");
    EXPECT_EQ(fitted("a-word-that-is-longer-than-the-screen", 20), "a-word-that-is-longer-than-the-screen");
}

} // namespace
} // namespace kaya
