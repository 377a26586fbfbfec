#include "commands/program/text_table.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

TEST(TextTable, AlignsNumbersToTheRightAndWordsToTheLeft) {
    TextTable table({"block", "kind", "volume"});
    table.add({"1", "rigid", "0.5"});
    table.add({"12", "deformable", "1e-06"});
    EXPECT_EQ(table.text(), "block  kind        volume\n"
                            "    1  rigid          0.5\n"
                            "   12  deformable   1e-06");
}

TEST(TextTable, AMixedColumnIsWords) {
    TextTable table({"value"});
    table.add({"1"});
    table.add({"-"});
    table.add({"free"});
    EXPECT_EQ(table.text(), "value\n1\n-\nfree");
}

TEST(TextTable, HeadingsAloneAreATable) {
    EXPECT_EQ(TextTable({"a", "b"}).text(), "a  b");
    EXPECT_EQ(TextTable({"a", "b"}).size(), 0u);
}

TEST(NumberText, WritesSixDigitsAsFishDoes) {
    EXPECT_EQ(number_text(9.94099e-06), "9.94099e-06");
    EXPECT_EQ(number_text(322.0774), "322.077");
    EXPECT_EQ(number_text(-202837.0), "-202837");
    EXPECT_EQ(number_text(20.0), "20");
    EXPECT_EQ(number_text(-0.0), "0");
}

} // namespace
} // namespace kaya
