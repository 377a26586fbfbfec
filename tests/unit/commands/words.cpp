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

TEST(Words, HistoryRecordsFieldsAndRatesOfThem) {
    Words recorded = words_of(lang::recorded_words()), fields_with_words;
    for (const std::string_view rate : {"xacc", "yacc", "zacc"})
        EXPECT_EQ(recorded.erase(rate), 1u) << rate; // of xvel, yvel, zvel
    for (const Field& field : fields())
        if (!field.history.empty()) fields_with_words.insert(field.history);
    // Components of shear have no keyword of their own.
    for (const std::string_view part : {"xsdis", "ysdis", "zsdis", "xsfor", "ysfor", "zsfor"})
        EXPECT_EQ(fields_with_words.erase(part), 1u) << part;
    EXPECT_EQ(recorded, fields_with_words);
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
