#include "base/csv.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <utility>
#include <vector>

namespace kaya {
namespace {

TEST(Csv, TextsAreNoFormulas) {
    const std::vector<std::pair<std::string, std::string>> rows{
        {"plain", "plain"},
        {"a, b", "\"a, b\""},
        {"the \"base\"", "\"the \"\"base\"\"\""},
        {"=1+1", "'=1+1"},
        {"=HYPERLINK(\"http://x\",\"y\")", "\"'=HYPERLINK(\"\"http://x\"\",\"\"y\"\")\""},
        {"+cmd|' /C calc'!A0", "'+cmd|' /C calc'!A0"},
        {"-2+3", "'-2+3"},
        {"@SUM(A1)", "'@SUM(A1)"},
        {"\t=1", "'\t=1"},
        {"\r=1", "\"'\r=1\""},
        {"\n=1", "\"'\n=1\""},
        {"\uFF1D1+1", "'\uFF1D1+1"},
        {"-", "-"},
        {"-+", "'-+"},
        {"a=b", "a=b"},
        {"'=1", "'=1"},
        {"", ""},
    };
    for (const auto& [text, cell] : rows) EXPECT_EQ(csv_cell(text), cell);
}

TEST(Csv, NumbersStayNumbers) {
    for (const char* number : {"-1", "+1", "-0.5", "-1e-300", "-1e400", "+2.5E3", "-inf", "25.0"})
        EXPECT_EQ(csv_cell(std::string(number)), number);
    for (const char* text : {"-1 m", "+-1", "-1e", "--1", "+x"})
        EXPECT_EQ(csv_cell(std::string(text)), std::string("'") + text);
    EXPECT_EQ(csv_cell(-0.1), "-0.1");
    EXPECT_EQ(csv_cell(std::numeric_limits<double>::quiet_NaN()), "");
}

} // namespace
} // namespace kaya
