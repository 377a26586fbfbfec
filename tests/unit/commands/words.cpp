// Words that are in a table of the language and in one of the model: both tables agree.
#include "lang/commands/language.hpp"
#include "lang/commands/property_words.hpp"
#include "laws/joint_model.hpp"
#include "model/structures/cables.hpp"
#include "model/fields/field.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace kaya {
namespace {

using Words = std::set<std::string_view>;

Words words_of(const std::vector<std::string_view>& list) {
    const Words words(list.begin(), list.end());
    EXPECT_EQ(words.size(), list.size()) << "a word stands twice";
    return words;
}

TEST(Words, HistoryRecordsFieldsOfTheModel) {
    for (const auto& [kind, name] : lang::recorded_fields()) {
        EXPECT_NE(find_field(kind, name), nullptr) << name;
        EXPECT_GE(info_of(kind).history, 0) << name;
    }
}

TEST(Words, PropertiesOfStructuresAreThoseOfTheModel) {
    Words of_model;
    for (const auto& property : structure_properties()) of_model.insert(property.name);
    EXPECT_EQ(words_of(lang::structure_property_words()), of_model);
}

TEST(Words, PropertiesOfJointsAreThoseOfMohr) {
    JointRegistry joints;
    joints.set_path({KAYA_TEST_JOINTS});
    const JointModel& mohr = joints.get("mohr");
    for (const auto& property : lang::joint_property_words())
        for (const auto& spelling : property.words)
            EXPECT_EQ(mohr.find_property(spelling.word), mohr.find_property(property.name)) << spelling.word;
}

TEST(Words, PropertiesOfBlocksStandInTheOrderOfTheirNumbers) {
    using enum lang::BlockProperty;
    constexpr std::pair<lang::BlockProperty, std::string_view> names[] = {
        {density, "density"},    {bulk, "bulk"},        {shear, "shear"},
        {young, "ymodulus"},     {poisson, "pratio"},   {cohesion, "bcohesion"},
        {friction, "bfriction"}, {tension, "btension"}, {dilation, "bdilation"}};
    const auto& known = lang::block_property_words();
    ASSERT_EQ(known.size(), lang::block_property_count);
    for (const auto& [property, name] : names) {
        const auto& words = known[static_cast<std::size_t>(property)];
        EXPECT_EQ(words.name, name);
        EXPECT_TRUE(std::ranges::any_of(words.words, [&, &n = name](const auto& w) { return w.word == n; })) << name;
    }
}

} // namespace
} // namespace kaya
