#include "model/fields/sampling.hpp"

#include "base/diagnostic.hpp"
#include "model/fields/field.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace kaya;
using kaya::test::hand_made_model;
using Kind = HistorySource::Kind;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Diagnostic& d) { return d.message + " | " + d.hint; }
    return "nothing was thrown";
}

} // namespace

TEST(Locate, TheNearestRowOfEachKind) {
    const Model model = hand_made_model();
    HistorySource gridpoint{Kind::gridpoint, "x_displacement", Vec3(0.1, 0, 0.9)};
    locate(model, gridpoint);
    EXPECT_EQ(gridpoint.row, 3);
    HistorySource vertex{Kind::gridpoint, "x_displacement", Vec3(0, 0, -5)};
    locate(model, vertex);
    EXPECT_EQ(vertex.row, 7);
    HistorySource zone{Kind::zone, "zz_stress", Vec3(9, 9, 9)};
    locate(model, zone);
    EXPECT_EQ(zone.row, 0);
    HistorySource sub_contact{Kind::sub_contact, "shear_stress", Vec3(0.6, 0, 0)};
    locate(model, sub_contact);
    EXPECT_EQ(sub_contact.row, 1);
    HistorySource block{Kind::block, "z_velocity", Vec3(0, 0, -1)};
    locate(model, block);
    EXPECT_EQ(block.row, 1);
}

TEST(Locate, OfTwoAtTheSameDistanceTheLowerRow) {
    const Model model = hand_made_model();
    HistorySource source{Kind::gridpoint, "x_displacement", Vec3(0, 0, 0)}; // gridpoint 0 and vertex 4
    locate(model, source);
    EXPECT_EQ(source.row, 0);
}

TEST(Locate, HiddenBlocksCountToo) {
    Model model = hand_made_model();
    model.blocks.hidden[0] = 1;
    HistorySource source{Kind::gridpoint, "x_displacement", Vec3(0, 0, 1)};
    locate(model, source);
    EXPECT_EQ(source.row, 3);
}

TEST(Locate, AnEmptyModelGivesAMessageWithARemedy) {
    const Model model;
    HistorySource source{Kind::zone, "zz_stress"};
    EXPECT_EQ(message_of([&] { locate(model, source); }),
              "there are no zones for a history | make zones (generate edge ...) before this history");
}

TEST(AddHistory, NumbersCountUpAndAnEmptyLabelBecomesTheQuantity) {
    Model model = hand_made_model();
    add_history(model, {Kind::global, "unbalanced_force"});
    const History& second = add_history(model, {Kind::function, "sstav"}, "Shear Stress");
    EXPECT_EQ(model.histories.all[0].number, 1);
    EXPECT_EQ(model.histories.all[0].label, "unbalanced_force");
    EXPECT_EQ(second.number, 2);
    EXPECT_EQ(second.label, "Shear Stress");
}

TEST(AddHistory, AnUnknownQuantityIsRefusedAndNothingIsAdded) {
    Model model = hand_made_model();
    EXPECT_EQ(message_of([&] {
                  add_history(model, {Kind::sub_contact, "shear_stres"});
              }),
              "'shear_stres' is not a quantity of sub-contacts | did you mean 'shear_stress'?");
    EXPECT_THAT(message_of([&] {
                    add_history(model, {Kind::global, "zz_stress"});
                }),
                HasSubstr("'zz_stress' is not a quantity of the whole model"));
    EXPECT_TRUE(model.histories.all.empty());
}

TEST(AddHistory, ANonNumericQuantityIsRefused) {
    Model model = hand_made_model();
    EXPECT_THAT(message_of([&] {
                    add_history(model, {Kind::gridpoint, "velocity"});
                }),
                HasSubstr("'velocity' is not a number"));
    EXPECT_THAT(message_of([&] { add_history(model, {Kind::block, "group"}); }), HasSubstr("'group' is not a number"));
    EXPECT_TRUE(model.histories.all.empty());
}

TEST(SampleHistories, ValuesTimeAndCycleAreAppended) {
    Model model = hand_made_model();
    add_history(model, {Kind::global, "unbalanced_force"});
    add_history(model, {Kind::sub_contact, "shear_stress", Vec3(0.25, 0.25, 0)});
    add_history(model, {Kind::zone, "zz_stress"});
    add_history(model, {Kind::function, "area"});
    std::string asked;
    const auto script = [&](const std::string& name) {
        asked += name;
        return 3.25;
    };
    sample_histories(model, 1, script);
    model.clock.time = 0.2;
    model.clock.cycle = 52;
    model.zones.stress[0][2] = -4;
    sample_histories(model, 1, script);
    EXPECT_EQ(asked, "areaarea");
    EXPECT_THAT(model.histories.time, ElementsAre(0.1, 0.2));
    EXPECT_THAT(model.histories.cycle, ElementsAre(42, 52));
    EXPECT_THAT(model.histories.all[0].values, ElementsAre(12.5, 12.5));
    EXPECT_THAT(model.histories.all[1].values, ElementsAre(20, 20));
    EXPECT_THAT(model.histories.all[2].values, ElementsAre(-3, -4));
    EXPECT_THAT(model.histories.all[3].values, ElementsAre(3.25, 3.25));
}

TEST(SampleHistories, OnlyEveryIntervalAndOnlyWhenThereAreHistories) {
    Model model = hand_made_model();
    sample_histories(model, 1, {});
    EXPECT_TRUE(model.histories.time.empty());
    add_history(model, {Kind::global, "cycle"});
    model.histories.interval = 5;
    for (model.clock.cycle = 0; model.clock.cycle <= 12; ++model.clock.cycle) sample_histories(model, 1, {});
    EXPECT_THAT(model.histories.all[0].values, ElementsAre(0, 5, 10));
    EXPECT_THAT(model.histories.cycle, ElementsAre(0, 5, 10));
}

TEST(SampleHistories, ALaterHistoryKnowsHowManySamplesItMissed) {
    Model model = hand_made_model();
    add_history(model, {Kind::global, "time"});
    sample_histories(model, 1, {});
    add_history(model, {Kind::global, "cycle"});
    sample_histories(model, 1, {});
    EXPECT_EQ(model.histories.all[1].first_sample, 1u);
    EXPECT_THAT(model.histories.all[1].values, ElementsAre(42));
    reset_histories(model.histories);
    EXPECT_EQ(model.histories.all[1].first_sample, 0u);
    EXPECT_TRUE(model.histories.time.empty());
    EXPECT_EQ(model.histories.all.size(), 2u);
}

TEST(SampleHistories, AFailingFunctionLeavesNoHalfSample) {
    Model model = hand_made_model();
    add_history(model, {Kind::global, "time"});
    add_history(model, {Kind::function, "bad"});
    const auto fails = [](const std::string&) -> double { throw Diagnostic("division of a number by nil"); };
    EXPECT_THROW(sample_histories(model, 1, fails), Diagnostic);
    EXPECT_THROW(sample_histories(model, 1, {}), Diagnostic);
    EXPECT_TRUE(model.histories.all[0].values.empty());
    EXPECT_TRUE(model.histories.time.empty());
}

TEST(SampleHistories, AnObjectIsFollowedWhenItsRowChanges) {
    Model model = hand_made_model();
    add_history(model, {Kind::sub_contact, "normal_force", Vec3(0.25, 0.25, 0)}); // row 0, force 10
    auto& sub = model.sub_contacts;
    sub.gather({1, 0});
    for (Row i = 0; i < 2; ++i) sub.ids.move(sub.id[i], i);
    sample_histories(model, 1, {});
    EXPECT_EQ(model.histories.all[0].source.row, 1);
    EXPECT_THAT(model.histories.all[0].values, ElementsAre(10));
}

TEST(SampleHistories, WhenTheObjectIsGoneTheNearestOneIsTaken) {
    Model model = hand_made_model();
    add_history(model, {Kind::sub_contact, "normal_force", Vec3(0.25, 0.25, 0)});
    auto& sub = model.sub_contacts;
    sub.ids.destroy(sub.id[0]);
    sub.gather({1});
    sub.ids.move(sub.id[0], 0);
    sample_histories(model, 1, {});
    EXPECT_THAT(model.histories.all[0].values, ElementsAre(20));
}

TEST(SampleHistories, WhenNoneOfTheKindIsLeftTheSampleIsNaN) {
    Model model = hand_made_model();
    add_history(model, {Kind::sub_contact, "normal_force", Vec3(0.25, 0.25, 0)});
    auto& sub = model.sub_contacts;
    for (const auto id : sub.id) sub.ids.destroy(id);
    sub.resize(0);
    sample_histories(model, 1, {});
    EXPECT_TRUE(std::isnan(model.histories.all[0].values[0]));
}

TEST(SampleHistories, AGridpointIsFoundAgainAfterItsBlockWasZoned) {
    Model model = hand_made_model();
    add_history(model, {Kind::gridpoint, "z", Vec3(0, 0, -1)}); // vertex 7 of block row 1
    ASSERT_EQ(model.histories.all[0].source.row, 7);
    // The block gets a fifth gridpoint before the others.
    auto& gridpoints = model.gridpoints;
    gridpoints.gather({0, 1, 2, 3, 4, 4, 5, 6, 7});
    model.blocks.gridpoints[1] = {4, 5};
    sample_histories(model, 1, {});
    EXPECT_EQ(model.histories.all[0].source.row, 8);
    EXPECT_THAT(model.histories.all[0].values, ElementsAre(-1));
}
