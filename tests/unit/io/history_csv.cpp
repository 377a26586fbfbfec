#include "io/history_csv.hpp"

#include "base/diagnostic.hpp"
#include "model/fields/sampling.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace kaya;
using namespace kaya::test;
using Kind = HistorySource::Kind;

namespace {

Model sampled_model() {
    Model model = hand_made_model();
    add_history(model, {Kind::global, "unbalanced_force"});
    add_history(model, {Kind::function, "sstav"}, "Shear Stress");
    double value = 0.1;
    const auto script = [&value](const std::string&) { return value; };
    sample_histories(model, 1, script);
    add_history(model, {Kind::sub_contact, "shear_displacement", Vec3(-1, -1, 0)});
    value = 1.0 / 3.0;
    model.clock.time = 0.25;
    model.clock.cycle = 52;
    model.clock.unbalanced_force = 1e-300;
    sample_histories(model, 1, script);
    return model;
}

std::string error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Diagnostic& d) { return d.message + " | " + d.hint; }
    return "nothing was thrown";
}

} // namespace

TEST(HistoryCsv, OneHeaderRowThenARowPerSample) {
    const Model model = sampled_model();
    EXPECT_EQ(history_csv(model.histories, {}, {}),
              "cycle,time,1:unbalanced_force [force],2:Shear Stress [script sstav],"
              "\"3:shear_displacement [length, sub-contact nearest to -1 -1 0]\"\n"
              "42,0.1,12.5,0.1,\n"
              "52,0.25,1e-300,0.3333333333333333,0.005\n");
}

TEST(HistoryCsv, NumbersPickColumnsInTheirOrder) {
    const Model model = sampled_model();
    EXPECT_EQ(history_csv(model.histories, {2, 1}, {}),
              "cycle,time,2:Shear Stress [script sstav],1:unbalanced_force [force]\n"
              "42,0.1,0.1,12.5\n52,0.25,0.3333333333333333,1e-300\n");
}

TEST(HistoryCsv, VersusPutsAHistoryInTheFirstColumn) {
    const Model model = sampled_model();
    EXPECT_EQ(history_csv(model.histories, {2}, 1),
              "1:unbalanced_force [force],2:Shear Stress [script sstav]\n12.5,0.1\n1e-300,0.3333333333333333\n");
    const std::string all = history_csv(model.histories, {}, 3);
    EXPECT_EQ(all.substr(all.find('\n') + 1), ",12.5,0.1\n0.005,1e-300,0.3333333333333333\n");
}

TEST(HistoryCsv, EveryBitSurvives) {
    Model model = hand_made_model();
    add_history(model, {Kind::function, "f"});
    const std::vector<double> values{1.0 / 3, 1e-308, -0.0, 123456789.123456789, 5e-324, 1.7976931348623157e308};
    std::size_t next = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
        sample_histories(model, 1, [&](const std::string&) { return values[next++]; });
    std::istringstream text(history_csv(model.histories, {}, {}));
    std::string line;
    std::getline(text, line);
    for (const double value : values) {
        ASSERT_TRUE(std::getline(text, line));
        const double back = std::strtod(line.substr(line.rfind(',') + 1).c_str(), nullptr);
        EXPECT_EQ(back, value);
        EXPECT_EQ(std::signbit(back), std::signbit(value));
    }
}

TEST(HistoryCsv, LabelsWithSeparatorsAreQuoted) {
    Model model = hand_made_model();
    add_history(model, {Kind::global, "time"}, "a \"b\", c");
    EXPECT_EQ(history_csv(model.histories, {}, {}), "cycle,time,\"1:a \"\"b\"\", c [time, time]\"\n");
}

TEST(HistoryCsv, NoHistoryGivesTheTimesOnly) {
    const Model model = hand_made_model();
    EXPECT_EQ(history_csv(model.histories, {}, {}), "cycle,time\n");
}

TEST(HistoryCsv, AnUnknownNumberListsTheExistingOnes) {
    const Model model = sampled_model();
    EXPECT_EQ(error_of([&] { history_csv(model.histories, {7}, {}); }),
              "there is no history 7 | histories 1 to 3 are defined");
    EXPECT_EQ(error_of([&] { history_csv(model.histories, {1}, 0); }),
              "there is no history 0 | histories 1 to 3 are defined");
    EXPECT_EQ(error_of([] { history_csv(Histories{}, {1}, {}); }), "there is no history 1 | no history is defined");
}

TEST(HistoryCsv, AFullDiskLeavesTheFileFromBefore) {
    const ScratchFolder folder;
    const Model model = sampled_model();
    write_history_csv(model.histories, folder / "h.csv", {}, {});
    const std::string before = content_of(folder / "h.csv");
    EXPECT_EQ(before, history_csv(model.histories, {}, {}));
    {
        const SmallDisk disk(50);
        EXPECT_THROW(write_history_csv(model.histories, folder / "h.csv", {1}, {}), Diagnostic);
    }
    EXPECT_EQ(content_of(folder / "h.csv"), before);
    EXPECT_EQ(folder.file_count(), 1u);
}
