#include "base/markup_text.hpp"

#include <gtest/gtest.h>

namespace {

TEST(MarkupText, TakesNoMarkAndNoControlLetter) {
    EXPECT_EQ(kaya::markup_text("<a href='x'>&\"\x01"), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;");
    EXPECT_EQ(kaya::markup_text("two\n\tlines\r"), "two\n\tlines");
}

} // namespace
