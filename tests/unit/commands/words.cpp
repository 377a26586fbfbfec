// Words that stand in a table of the language and in one of the model: the two say the same.
#include "lang/commands/language.hpp"
#include "laws/joint_model.hpp"
#include "model/cables.hpp"
#include "model/field.hpp"

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
    for (const auto& property : cable_properties()) of_model.insert(property.name);
    EXPECT_EQ(words_of(lang::structure_property_words()), of_model);
}

TEST(Words, PropertiesOfJointsAreThoseOfMohr) {
    JointRegistry joints;
    joints.set_path({KAYA_TEST_JOINTS});
    const JointModel& mohr = joints.get("mohr");
    for (const auto word : words_of(lang::joint_property_words())) EXPECT_TRUE(mohr.find_property(word)) << word;
}

} // namespace
} // namespace kaya
