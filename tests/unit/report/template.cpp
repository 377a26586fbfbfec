// Templates of the report: values in their places, parts that are left out.
#include "report/template.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

namespace kaya {
namespace {

TEST(Template, PutsValuesInTheirPlaces) {
    EXPECT_EQ(filled("<h1>{{title}}</h1>{{title}} {x} }}", {{"title", "a {{b}}"}}), "<h1>a {{b}}</h1>a {{b}} {x} }}");
    EXPECT_EQ(filled("", {}), "");
}

TEST(Template, LeavesOutPartsWithoutAValue) {
    const char* const text = "one\n{{#two}}\ntwo {{two}}\n{{/two}}\nthree\n";
    EXPECT_EQ(filled(text, {{"two", ""}}), "one\nthree\n");
    EXPECT_EQ(filled(text, {{"two", "2"}}), "one\ntwo 2\nthree\n");
}

TEST(Template, RefusesWhatIsIncomplete) {
    EXPECT_THROW(filled("{{title}}", {}), std::logic_error);
    EXPECT_THROW(filled("{{title", {{"title", ""}}), std::logic_error);
    EXPECT_THROW(filled("{{#part}}\n", {{"part", "1"}}), std::logic_error);
}

} // namespace
} // namespace kaya
