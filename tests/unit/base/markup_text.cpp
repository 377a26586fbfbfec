#include "base/markup_text.hpp"

#include <gtest/gtest.h>

namespace {

TEST(MarkupText, EscapesMarksAndControlCharacters) {
    EXPECT_EQ(kaya::markup_text("<a href='x'>&\"\x01"), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;\\x01");
    EXPECT_EQ(kaya::markup_text("two\n\tlines\r"), "two\n\tlines\\x0d");
    EXPECT_EQ(kaya::markup_text("caf\u00e9 \xff \u202E"),
              "caf\u00e9 \\xff \\xe2\\x80\\xae"); // otherwise no XML, or in another order
}

} // namespace
