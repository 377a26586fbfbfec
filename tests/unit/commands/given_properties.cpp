#include "commands/session/given_properties.hpp"

#include "base/diagnostic.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

using Items = std::vector<lang::Property::Item>;

TEST(GivenProperties, ReplaceValuesByAnySpellingOfTheWord) {
    GivenProperties given;
    given.give("prop 1 jfric", 30, {});
    given.give("property mat 1 K", 5e9, {});
    given.give("jmodel kn", 1e8, {});
    given.give("prop 1 jfriction", 99, {}); // the first value of a name applies
    const auto items = given.replaced(Items{{"jfriction", 20, {}}, {"bulk", 1, {}}, {"density", 7, {}}}, 1);
    EXPECT_EQ(items[0].value, 30);
    EXPECT_EQ(items[1].value, 5e9);
    EXPECT_EQ(items[2].value, 7);
    EXPECT_EQ(given.unused(), std::vector<std::string>{"jmodel kn"});
    EXPECT_EQ(given.replaced(Items{{"jfric", 20, {}}}, 2)[0].value, 20);
    EXPECT_EQ(given.replaced(Items{{"jkn", 20, {}}}, GivenProperties::of_jmodel)[0].value, 1e8);
    EXPECT_TRUE(given.unused().empty());
}

TEST(GivenProperties, OtherNamesAreRefused) {
    for (const char* name : {"prop jfric", "prop 0 jfric", "prop x jfric", "prop 1 2 jfric", "jmodel 1 jfric",
                             "boundary 1 x", " ", "prop 1.5 jfric"})
        EXPECT_THROW(GivenProperties().give(name, 1, {}), Diagnostic) << name;
}

} // namespace
} // namespace kaya
